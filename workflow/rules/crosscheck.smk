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


make_rule(
    "crosscheck_own",
    call="nucleation.simulation.run:simulate",
    shows="crosscheck/own/{name}",
    loads=lambda wildcards: plugins(CROSSCHECKS[wildcards.name]),
    parameters=lambda wildcards: CROSSCHECKS[wildcards.name].to_dict(),
    message="Crosscheck {wildcards.name} with the project's solver",
)

make_rule(
    "crosscheck_freefem",
    call="nucleation.verification.crosscheck.freefem:of_run",
    shows="crosscheck/freefem/{name}",
    inputs={"scripts": freefem_scripts},
    loads=lambda wildcards: plugins(CROSSCHECKS[wildcards.name]),
    parameters=lambda wildcards: CROSSCHECKS[wildcards.name].to_dict(),
    crosscheck=asdict(settings.crosscheck),
    settings=asdict(settings.extraction),
    message="Crosscheck {wildcards.name} with FreeFem++",
)

make_rule(
    "compare_crosscheck",
    call="nucleation.verification.crosscheck.compare:compared",
    shows="crosscheck",
    inputs={"own": crosschecks("own"), "freefem": crosschecks("freefem")},
    ids=list(CROSSCHECKS),
    settings=asdict(settings.extraction),
    message="Crosscheck: differences of the two solvers",
)

make_rule(
    "draw_figure_crosscheck",
    call="nucleation.figures.checks.figure_crosscheck:draw",
    shows="figures/figure_crosscheck",
    suffix="png",
    local=True,
    inputs={
        "own": crosschecks("own"),
        "freefem": crosschecks("freefem"),
        "table": only("compare_crosscheck"),
    },
    settings=asdict(settings.extraction),
    message="Crosscheck: patch length and driving force by both solvers",
)
