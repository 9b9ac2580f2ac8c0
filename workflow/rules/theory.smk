# The linear theory, and single modes of homogeneous sliding integrated in time.
rule theory:
    """Theory: critical lengths and friction curves"""
    input:
        recipe=recipe("theory"),
    output:
        f"{RESULTS}/theory.nc",
    log:
        f"{RESULTS}/logs/theory.log",
    priority: EARLY
    params:
        call="replication.tables.curves:theory_dataset",
        loads=plugins(settings.base.law),
        base=settings.base.to_dict(),
        curves=lambda wildcards: asdict(settings.drawn_curves()),
    shell:
        JOB


# Single modes of homogeneous sliding: time integration and spectrum.
rule dispersion:
    """Growth of single modes: time integration and theory"""
    input:
        recipe=recipe("dispersion"),
    output:
        multiext(f"{RESULTS}/dispersion", ".nc", ".csv"),
    log:
        f"{RESULTS}/logs/dispersion.log",
    priority: EARLY + 1  # it compiles for the simulations meanwhile
    params:
        call="replication.tables.modes:dispersion_files",
        loads=plugins(settings.base.law),
        base=settings.base.to_dict(),
    shell:
        JOB


# The same between two sliding layers, for Eqs. (7) and (8).
rule pair_modes:
    """Growth of single modes between two layers: time integration and theory"""
    input:
        recipe=recipe("pair_modes"),
    output:
        multiext(f"{RESULTS}/pair_modes", ".nc", ".csv"),
    log:
        f"{RESULTS}/logs/pair_modes.log",
    params:
        call="replication.tables.modes:pair_mode_files",
        loads=plugins(settings.base.law),
        base=settings.base.to_dict(),
    shell:
        JOB


rule table_s1:
    """Table S1: parameters of the friction law"""
    input:
        recipe=recipe("table_s1"),
    output:
        multiext(f"{RESULTS}/tables/table_s1", ".md", ".csv"),
    log:
        f"{RESULTS}/logs/tables/table_s1.log",
    priority: EARLY
    localrule: True
    params:
        call="replication.figures.theory:table_s1",
        loads=plugins(settings.base.law),
        friction=asdict(settings.base.law),
    shell:
        JOB
