# The linear theory: all its curves in one dataset.
rule theory:
    output:
        THEORY,
    params:
        parameters=settings.theory_parameters(),
        digest=digest("nucleation.theory.curves"),
    message:
        "Theory: critical lengths and friction curves"
    script:
        "../scripts/theory.py"
