# The linear theory: all its curves in one dataset.
rule theory:
    output:
        THEORY,
    log:
        f"{RESULTS}/logs/theory.log",
    priority: 1
    params:
        **made_by("theory.py", plugins(settings.base)),
        parameters=settings.theory_parameters(),
    message:
        "Theory: critical lengths and friction curves"
    script:
        "../scripts/theory.py"
