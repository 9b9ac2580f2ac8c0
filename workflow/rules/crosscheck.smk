# The independent solver: the same runs by FreeFem++ and by the project's own solver. Not a part of
# `paper`: it needs a program that make doesn't install, and takes ten minutes.
from hashlib import sha256

from nucleation.verification.crosscheck import freefem, plan

CROSSCHECKS = plan.runs(settings.base, settings.crosscheck, settings.main_text_interface)
FREEFEM_SCRIPT = Path(workflow.basedir, "workflow", "crosscheck", "block.edp")


def freefem_script(wildcards):
    """The script, if there is a program to run it: without one, nothing at all is started."""
    if not freefem.installed():
        raise WorkflowError(freefem.MISSING)
    return str(FREEFEM_SCRIPT)


def crosscheck_records(solver):
    return [f"{RESULTS}/crosscheck/{id}-{solver}.nc" for id in CROSSCHECKS]


wildcard_constraints:
    crosscheck="|".join(CROSSCHECKS).replace(".", r"\."),


rule crosscheck_own:
    output:
        f"{RESULTS}/crosscheck/{{crosscheck}}-own.nc",
    params:
        parameters=lambda wildcards: CROSSCHECKS[wildcards.crosscheck].to_dict(),
        digest=digest("nucleation.simulation.run"),
    threads: 1
    message:
        "Crosscheck {wildcards.crosscheck} with the project's solver"
    script:
        "../scripts/crosscheck_own.py"


rule crosscheck_freefem:
    input:
        script=freefem_script,
    output:
        f"{RESULTS}/crosscheck/{{crosscheck}}-freefem.nc",
    params:
        parameters=lambda wildcards: CROSSCHECKS[wildcards.crosscheck].to_dict(),
        settings=asdict(settings.crosscheck),
        extraction=asdict(settings.extraction),
        script=sha256(FREEFEM_SCRIPT.read_bytes()).hexdigest(),
        digest=digest("nucleation.verification.crosscheck.freefem"),
    threads: 1
    message:
        "Crosscheck {wildcards.crosscheck} with FreeFem++"
    script:
        "../scripts/crosscheck_freefem.py"


rule compare_crosscheck:
    input:
        own=crosscheck_records("own"),
        freefem=crosscheck_records("freefem"),
    output:
        dataset=f"{RESULTS}/crosscheck.nc",
        table=f"{RESULTS}/crosscheck.csv",
    params:
        ids=list(CROSSCHECKS),
        extraction=asdict(settings.extraction),
        digest=digest("nucleation.verification.crosscheck.compare"),
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
    params:
        ids=list(CROSSCHECKS),
        extraction=asdict(settings.extraction),
        digest=drawing_digest("figure_crosscheck"),
    message:
        "Crosscheck: patch length and driving force by both solvers"
    script:
        "../scripts/figure_crosscheck.py"


localrules:
    figure_crosscheck,
    crosscheck,


rule figure_crosscheck:
    input:
        rules.draw_figure_crosscheck.output,
        rules.compare_crosscheck.output,
        crosscheck_records("own"),
        crosscheck_records("freefem"),
    message:
        "The crosscheck's figure is in {input[0]}"


rule crosscheck:
    input:
        table=rules.compare_crosscheck.output.table,
        figure=rules.figure_crosscheck.input,
    message:
        "The two solvers are compared in {input.table} and {input.figure[0]}"
