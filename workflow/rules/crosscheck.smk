# The independent solver: the same runs by FreeFem++ and by the project's own solver. Not a part of
# `paper`: it needs a program that make doesn't install, and takes twenty minutes.
from nucleation.verification.crosscheck import freefem, plan

CROSSCHECKS = plan.runs(settings.base, settings.crosscheck, settings.main_text_interface)
FREEFEM_SCRIPTS = sorted(map(str, Path(BASE, "workflow", "crosscheck").glob("*.edp")))


def freefem_scripts(wildcards):
    """The scripts, if there is a program to run them: without one, nothing at all is started."""
    if not freefem.installed():
        raise WorkflowError(freefem.MISSING)
    return FREEFEM_SCRIPTS


def crosschecks(solver):
    """An input function that gives the records of all runs by one of the solvers."""
    return lambda wildcards: steps.several(f"crosscheck_{solver}", CROSSCHECKS)


rule crosscheck_own:
    output:
        link("crosscheck/own/{name}"),
    log:
        log("crosscheck/own/{name}"),
    threads: 1
    params:
        call="nucleation.verification.crosscheck.timed:own",
        loads=lambda wildcards: plugins(CROSSCHECKS[wildcards.name]),
        parameters=lambda wildcards: CROSSCHECKS[wildcards.name].to_dict(),
    message:
        "Crosscheck {wildcards.name} with the project's solver"
    script:
        STEP


rule crosscheck_freefem:
    input:
        scripts=freefem_scripts,
    output:
        link("crosscheck/freefem/{name}"),
    log:
        log("crosscheck/freefem/{name}"),
    threads: 1
    params:
        call="nucleation.verification.crosscheck.freefem:of_run",
        loads=lambda wildcards: plugins(CROSSCHECKS[wildcards.name]),
        parameters=lambda wildcards: CROSSCHECKS[wildcards.name].to_dict(),
        crosscheck=asdict(settings.crosscheck),
        settings=asdict(settings.extraction),
    message:
        "Crosscheck {wildcards.name} with FreeFem++"
    script:
        STEP


rule compare_crosscheck:
    input:
        own=crosschecks("own"),
        freefem=crosschecks("freefem"),
    output:
        link("crosscheck"),
    log:
        log("crosscheck"),
    params:
        call="nucleation.verification.crosscheck.compare:files",
        ids=list(CROSSCHECKS),
        settings=asdict(settings.extraction),
    message:
        "Crosscheck: differences of the two solvers"
    script:
        STEP


rule draw_figure_crosscheck:
    input:
        own=crosschecks("own"),
        freefem=crosschecks("freefem"),
        table=only("compare_crosscheck"),
    output:
        link("figures/figure_crosscheck", "png"),
    log:
        log("figures/figure_crosscheck"),
    params:
        call="nucleation.figures.checks.figure_crosscheck:draw_runs",
        ids=list(CROSSCHECKS),
        settings=asdict(settings.extraction),
    message:
        "Crosscheck: patch length and driving force by both solvers"
    script:
        STEP
