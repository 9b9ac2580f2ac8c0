# Verification of the solver, no part of the paper (docs/verification.md).
#
# The bridge between simulation and theory: single modes of homogeneous sliding, integrated in time
# by the simulations' solver, beside the spectrum. Orders of convergence: manufactured solutions,
# which depend on no configuration.
DISPERSION = f"{RESULTS}/dispersion.nc"
VERIFICATION = f"{RESULTS}/verification.nc"


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
        digest=digest("nucleation.verification.dispersion"),
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


rule verification:
    output:
        dataset=VERIFICATION,
        table=f"{RESULTS}/verification.csv",
    params:
        digest=digest("nucleation.verification.orders"),
    threads: 1
    message:
        "Convergence: errors of manufactured solutions against element size and time step"
    script:
        "../scripts/verification.py"


rule draw_figure_verification:
    input:
        verification=VERIFICATION,
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
        rules.verification.output,
    message:
        "The verification figure is in {input[0]}"
