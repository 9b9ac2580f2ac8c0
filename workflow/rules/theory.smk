# The linear theory: all its curves in one dataset.
rule theory:
    output:
        THEORY,
    params:
        material=asdict(settings.base.material),
        friction=asdict(settings.base.friction),
        main_text_interface=asdict(settings.main_text_interface),
        curves=asdict(settings.curves),
        digest=digest("nucleation.theory"),
    message:
        "Theory: critical lengths and friction curves"
    script:
        "../scripts/theory.py"
