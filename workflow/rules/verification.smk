# Verification of the solver, no part of the paper (docs/verification.md).
#
# The bridge between simulation and theory: single modes of homogeneous sliding, integrated in time
# by the simulations' solver, beside the spectrum. Orders of convergence: manufactured solutions,
# which depend on no configuration.
DISPERSION = f"{RESULTS}/dispersion.nc"
CONVERGENCE = f"{RESULTS}/convergence.nc"


localrules:
    figure_dispersion, figure_verification,


rule dispersion:
    output:
        dataset=DISPERSION,
        table=f"{RESULTS}/dispersion.csv",
    params:
        material=asdict(settings.base.material),
        friction=asdict(settings.base.friction),
        loading=asdict(settings.base.loading),
        digest=digest("nucleation.dispersion"),
    threads: 1
    message:
        "Dispersion: growth of single modes, time integration and theory"
    script:
        "../scripts/dispersion.py"


rule draw_figure_dispersion:
    input:
        dispersion=DISPERSION,
    output:
        figure("figure_dispersion"),
    params:
        digest=drawing_digest("figure_dispersion"),
    message:
        "Dispersion figure: growth and frequency against wavenumber"
    script:
        "../scripts/figure_dispersion.py"


rule figure_dispersion:
    input:
        figure("figure_dispersion"),
        rules.dispersion.output,
    message:
        "The dispersion figure is in {input[0]}"


rule convergence:
    output:
        dataset=CONVERGENCE,
        table=f"{RESULTS}/convergence.csv",
    params:
        digest=digest("nucleation.convergence"),
    threads: 1
    message:
        "Convergence: errors of manufactured solutions against element size and time step"
    script:
        "../scripts/convergence.py"


rule draw_figure_verification:
    input:
        convergence=CONVERGENCE,
    output:
        figure("figure_verification"),
    params:
        digest=drawing_digest("figure_verification"),
    message:
        "Verification figure: orders of convergence"
    script:
        "../scripts/figure_verification.py"


rule figure_verification:
    input:
        figure("figure_verification"),
        rules.convergence.output,
    message:
        "The verification figure is in {input[0]}"
