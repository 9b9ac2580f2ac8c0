# The independent solver: the same runs by FreeFem++ and by the project's own solver. They are not part
# of `paper`, since they take twenty minutes and need a program that make does not install.
FREEFEM_SCRIPTS = sorted(map(str, Path(BASE, "workflow", "crosscheck").glob("*.edp")))


@functools.cache
def crosschecks():
    """The runs of both solvers, by name."""
    from replication.verification.crosscheck import plan

    return plan.runs(settings.base, settings.crosscheck, settings.main_text_interface)


def crosschecked(solver):
    """An input function for the records of all runs by one of the solvers."""
    return lambda wildcards: [f"{RESULTS}/crosscheck/{solver}/{name}.nc" for name in crosschecks()]


def freefem_scripts(wildcards):
    """The scripts; without the program that runs them, the workflow stops before any job."""
    from replication.verification.crosscheck import freefem

    if not freefem.installed():
        raise WorkflowError(freefem.MISSING)
    return FREEFEM_SCRIPTS


rule crosscheck_own:
    """A run of the crosscheck by the project's own solver"""
    input:
        recipe=recipe("crosscheck_own"),
    output:
        f"{RESULTS}/crosscheck/own/{{name}}.nc",
    log:
        f"{RESULTS}/logs/crosscheck/own/{{name}}.log",
    params:
        call=f"{SIMULATION}:simulate",
        loads=lambda wildcards: plugins(crosschecks()[wildcards.name]),
        parameters=lambda wildcards: crosschecks()[wildcards.name].to_dict(),
    message:
        "Crosscheck {wildcards.name} with the project's solver"
    shell:
        JOB


rule crosscheck_freefem:
    """A run of the crosscheck by FreeFem++"""
    input:
        scripts=freefem_scripts,
        recipe=recipe("crosscheck_freefem"),
    output:
        f"{RESULTS}/crosscheck/freefem/{{name}}.nc",
    log:
        f"{RESULTS}/logs/crosscheck/freefem/{{name}}.log",
    params:
        call="replication.verification.crosscheck.freefem:of_run",
        loads=lambda wildcards: plugins(crosschecks()[wildcards.name]),
        parameters=lambda wildcards: crosschecks()[wildcards.name].to_dict(),
        crosscheck=asdict(settings.crosscheck),
        settings=asdict(settings.extraction),
    message:
        "Crosscheck {wildcards.name} with FreeFem++"
    shell:
        JOB


rule compare_crosscheck:
    """Differences of the two solvers"""
    input:
        own=crosschecked("own"),
        freefem=crosschecked("freefem"),
        recipe=recipe("compare_crosscheck"),
    output:
        multiext(f"{RESULTS}/crosscheck", ".csv", ".nc"),
    log:
        f"{RESULTS}/logs/crosscheck.log",
    params:
        call="replication.verification.crosscheck.compare:compared",
        ids=lambda wildcards: list(crosschecks()),
        settings=asdict(settings.extraction),
    message:
        "Crosscheck: differences of the two solvers"
    shell:
        JOB


rule figure_crosscheck:
    """Patch length and driving force by both solvers"""
    input:
        own=crosschecked("own"),
        freefem=crosschecked("freefem"),
        table=f"{RESULTS}/crosscheck.nc",
        recipe=recipe("figure_crosscheck"),
    output:
        multiext(f"{RESULTS}/figures/figure_crosscheck", ".png", ".pdf"),
    log:
        f"{RESULTS}/logs/figures/figure_crosscheck.log",
    localrule: True
    params:
        call="replication.figures.checks.figure_crosscheck:draw",
        settings=asdict(settings.extraction),
    message:
        "Crosscheck: patch length and driving force by both solvers"
    shell:
        JOB
