# Verification of the solver, no part of the paper (docs/verification.md).
#
# The bridge between simulation and theory: single modes of homogeneous sliding, integrated in time
# by the simulations' solver, beside the spectrum. Orders of convergence: manufactured solutions,
# which depend on no configuration.
DISPERSION = f"{RESULTS}/dispersion.nc"
VERIFICATION = f"{RESULTS}/verification.nc"


rule dispersion:
    output:
        dataset=DISPERSION,
        table=f"{RESULTS}/dispersion.csv",
    log:
        f"{RESULTS}/logs/dispersion.log",
    priority: 1  # the verdicts wait for it
    threads: 1
    params:
        **made_by("dispersion.py", plugins(settings.base)),
        material=asdict(settings.base.material),
        friction=asdict(settings.base.friction),
        loading=asdict(settings.base.loading),
    message:
        "Dispersion: growth of single modes, time integration and theory"
    script:
        "../scripts/dispersion.py"


rule verification:
    output:
        dataset=VERIFICATION,
        table=f"{RESULTS}/verification.csv",
    log:
        f"{RESULTS}/logs/verification.log",
    threads: 1
    params:
        **made_by("verification.py", EVOLUTIONS),
    message:
        "Convergence: errors of manufactured solutions against element size and time step"
    script:
        "../scripts/verification.py"
