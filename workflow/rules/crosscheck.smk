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


def crosscheck_parameters(id):
    return {
        "parameters": CROSSCHECKS[id].to_dict(),
        "settings": asdict(settings.crosscheck),
        "extraction": asdict(settings.extraction),
    }


@functools.cache
def crosscheck_record(id, solver):
    """The record of one run by one of the solvers, own or freefem."""
    parameters, sources = crosscheck_parameters(id), {"scripts": FREEFEM_SCRIPTS}
    if solver == "own":
        parameters, sources = {"parameters": parameters["parameters"]}, {}
    laws = plugins(CROSSCHECKS[id])
    return keyed(f"crosscheck/{solver}", id, f"crosscheck_{solver}.py", parameters, sources, laws)


def crosscheck_records(solver):
    return [crosscheck_record(id, solver) for id in CROSSCHECKS]


rule crosscheck_own:
    output:
        place_of("crosscheck/own"),
    log:
        f"{RESULTS}/logs/crosscheck/own/{{name}}.{{key}}.log",
    threads: 1
    params:
        **made_by("crosscheck_own.py", lambda wildcards: plugins(CROSSCHECKS[wildcards.name])),
        parameters=lambda wildcards: CROSSCHECKS[wildcards.name].to_dict(),
    message:
        "Crosscheck {wildcards.name} with the project's solver"
    script:
        "../scripts/crosscheck_own.py"


rule crosscheck_freefem:
    input:
        scripts=freefem_scripts,
    output:
        place_of("crosscheck/freefem"),
    log:
        f"{RESULTS}/logs/crosscheck/freefem/{{name}}.{{key}}.log",
    threads: 1
    params:
        **made_by("crosscheck_freefem.py", lambda wildcards: plugins(CROSSCHECKS[wildcards.name])),
        parameters=lambda wildcards: CROSSCHECKS[wildcards.name].to_dict(),
        settings=asdict(settings.crosscheck),
        extraction=asdict(settings.extraction),
    message:
        "Crosscheck {wildcards.name} with FreeFem++"
    script:
        "../scripts/crosscheck_freefem.py"


rule compare_crosscheck:
    input:
        own=crosscheck_records("own"),
        freefem=crosscheck_records("freefem"),
    output:
        dataset=f"{RESULTS}/crosscheck.nc",
        table=f"{RESULTS}/crosscheck.csv",
    log:
        f"{RESULTS}/logs/crosscheck.log",
    params:
        **made_by("compare_crosscheck.py"),
        ids=list(CROSSCHECKS),
        extraction=asdict(settings.extraction),
    message:
        "Crosscheck: differences of the two solvers"
    script:
        "../scripts/compare_crosscheck.py"


rule draw_figure_crosscheck:
    input:
        own=crosscheck_records("own"),
        freefem=crosscheck_records("freefem"),
        table=rules.compare_crosscheck.output.dataset,
    output:
        figure("figure_crosscheck"),
    log:
        f"{RESULTS}/logs/draw/figure_crosscheck.log",
    params:
        **made_by("figure_crosscheck.py"),
        ids=list(CROSSCHECKS),
        extraction=asdict(settings.extraction),
    message:
        "Crosscheck: patch length and driving force by both solvers"
    script:
        "../scripts/figure_crosscheck.py"


localrules:
    figure_crosscheck,
    crosscheck,


rule figure_crosscheck:
    """The figure of both solvers."""
    input:
        rules.draw_figure_crosscheck.output,
        rules.compare_crosscheck.output,
        crosscheck_records("own"),
        crosscheck_records("freefem"),
    message:
        "The crosscheck's figure is in {input[0]}"


rule crosscheck:
    """The same runs by an independent solver."""
    input:
        table=rules.compare_crosscheck.output.table,
        figure=rules.figure_crosscheck.input,
    message:
        "The two solvers are compared in {input.table} and {input.figure[0]}"
