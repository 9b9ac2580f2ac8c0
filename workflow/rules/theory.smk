# The linear theory, and what holds the solver against mathematics (docs/verification.md).
rule theory:
    output:
        link("theory"),
    log:
        log("theory"),
    priority: 1
    params:
        **CONFIGURED("material", "friction", "curves"),
        call="nucleation.theory.curves:theory_dataset",
        loads=plugins(settings.base),
        interface=asdict(settings.main_text_interface),
    message:
        "Theory: critical lengths and friction curves"
    script:
        STEP


# Single modes of homogeneous sliding, integrated in time, beside the spectrum.
rule dispersion:
    output:
        link("dispersion"),
    log:
        log("dispersion"),
    priority: 1  # the verdicts wait for it
    threads: 1
    params:
        **CONFIGURED("material", "friction", "loading"),
        call="nucleation.verification.dispersion:files",
        loads=plugins(settings.base),
    message:
        "Dispersion: growth of single modes, time integration and theory"
    script:
        STEP


# The same between two sliding layers, for Eqs. (7) and (8).
rule pair_modes:
    output:
        link("pair_modes"),
    log:
        log("pair_modes"),
    threads: 1
    params:
        **CONFIGURED("material", "friction", "loading"),
        call="nucleation.verification.pair_modes:files",
        loads=plugins(settings.base),
    message:
        "Growth of single modes between two layers, time integration and theory"
    script:
        STEP


# Orders of convergence on manufactured solutions, which depend on no configuration.
rule verification:
    output:
        link("verification"),
    log:
        log("verification"),
    threads: 1
    params:
        call="nucleation.verification.orders:files",
        loads=EVOLUTIONS,
    message:
        "Convergence: errors of manufactured solutions against element size and time step"
    script:
        STEP


rule write_table_s1:
    output:
        link("tables/table_s1", "md"),
    log:
        log("tables/table_s1"),
    params:
        **CONFIGURED("friction"),
        call="nucleation.figures.paper.table_s1:files",
        loads=plugins(settings.base),
    message:
        "Table S1: parameters of the friction law"
    script:
        STEP
