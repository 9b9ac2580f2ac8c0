# The bridge between simulation and theory: single modes of homogeneous sliding, integrated in time
# by the simulations' solver, beside the spectrum. A part of the verification, not of the paper.
DISPERSION = f"{RESULTS}/dispersion.nc"


rule dispersion:
    output:
        DISPERSION,
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


localrules:
    figure_dispersion,


rule figure_dispersion:
    input:
        figure("figure_dispersion"),
    message:
        "The dispersion figure is in {input[0]}"
