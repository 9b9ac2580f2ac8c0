# The linear theory: all its curves in one dataset.
rule theory:
    output:
        THEORY,
    params:
        parameters=settings.theory_parameters(),
        **made_by("theory.py", plugins(settings.base)),
    log:
        f"{RESULTS}/logs/theory.log",
    message:
        "Theory: critical lengths and friction curves"
    script:
        "../scripts/theory.py"
