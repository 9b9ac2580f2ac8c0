# Simulations and the tables of their lengths. A study with more than one run per job has batches:
# where other results are made of its simulations one by one, a rule makes those of a batch; else
# the job measures its runs itself, and Snakemake need not know of thousands of files.
from math import ceil

SIMULATED = "nucleation.simulation.run"


def memory(run, attempt):
    """Memory (MB) of a cluster job with one simulation: two Snakemakes in it need 150 MB each."""
    return attempt * ceil(300 + estimated_megabytes(run.parameters))


def batch_memory(name, attempt):
    return max(memory(run, attempt) for run in BATCHES[name])


rule simulate:
    output:
        link("simulations/{name}"),
    log:
        log("simulations/{name}"),
    priority: 1  # with all that the verdicts wait for: what is only drawn fills the cores at the end
    threads: 1
    resources:
        mem_mb=lambda wildcards, attempt: memory(RUNS[wildcards.name], attempt),
        runtime=ceil(settings.limits.runtime),
    params:
        call=f"{SIMULATED}:simulate",
        loads=lambda wildcards: plugins(RUNS[wildcards.name].parameters),
        parameters=lambda wildcards: RUNS[wildcards.name].parameters.to_dict(),
    message:
        "Simulation {wildcards.name}"
    script:
        "../scripts/simulate.py"


rule batch:
    output:
        link("batches/{name}"),
    log:
        log("batches/{name}"),
    priority: 1
    threads: 1
    resources:
        mem_mb=lambda wildcards, attempt: batch_memory(wildcards.name, attempt),
        runtime=ceil(settings.limits.runtime),
    params:
        call="nucleation.patch.batches:table",
        loads=lambda wildcards: [SIMULATED, *laws_of(BATCHES[wildcards.name])],
        runs=lambda wildcards: as_dicts(BATCHES[wildcards.name]),
        settings=asdict(settings.extraction),
        measure=lambda wildcards: settings.studies[BATCHES[wildcards.name][0].study].measure,
    message:
        "Simulations {wildcards.name}"
    script:
        "../scripts/batch.py"


for _name in BATCHED_ONE_BY_ONE:

    rule:
        name:
            f"simulate_{_name.replace('-', '_')}"
        output:
            [task.link for task in together("simulate", BATCHES[_name], f"batches/{_name}")],
        log:
            f"{RESULTS}/logs/batches/{_name}.log",
        priority: 2  # they take longest
        group:
            "batches"
        threads: 1
        resources:
            mem_mb=lambda wildcards, attempt, name=_name: batch_memory(name, attempt),
            runtime=ceil(settings.limits.runtime),
        params:
            each=together("simulate", BATCHES[_name], f"batches/{_name}"),
        message:
            f"Simulations {_name}"
        script:
            "../scripts/simulate.py"


# A table with onset time and critical length for each study, and one of the studies that share it.
rule extract:
    input:
        simulations=lambda wildcards: simulations(wildcards.name),
    output:
        link("lengths/{name}"),
    log:
        log("lengths/{name}"),
    wildcard_constraints:
        name=one_of(study for study in settings.studies if study not in TABLED),
    priority: 1
    params:
        call="nucleation.analysis.lengths:of_study",
        runs=lambda wildcards: as_dicts(settings.runs_of(wildcards.name)),
        settings=asdict(settings.extraction),
    message:
        "Critical lengths of the study {wildcards.name}"
    script:
        STEP


rule join_batches:
    input:
        tables=lambda wildcards: steps.several("batch", batches_of(wildcards.name)),
    output:
        link("lengths/{name}"),
    log:
        log("lengths/{name}"),
    wildcard_constraints:
        name=one_of(TABLED),
    params:
        call="nucleation.patch.batches:of_study",
        ids=lambda wildcards: [run.id for run in settings.runs_of(wildcards.name)],
    message:
        "Critical lengths of the study {wildcards.name}"
    script:
        STEP


rule gather_lengths:
    input:
        tables=needed(lambda wildcards: lengths_of(*SHARED), "study with table: lengths"),
    output:
        link("lengths"),
    log:
        log("lengths"),
    params:
        call="nucleation.analysis.lengths:of_studies",
    message:
        "Critical lengths of the studies " + ", ".join(SHARED)
    script:
        STEP
