# Simulations and the tables of their lengths. A study with more than one run per job has batches:
# where other results are made of its simulations one by one, a rule makes those of a batch; else
# the job measures its runs itself, and Snakemake need not know of thousands of files.
SIMULATED = "nucleation.simulation.run"


def memory(run, attempt):
    """Memory (MB) of a cluster job with one simulation: two Snakemakes in it need 150 MB each."""
    return attempt * ceil(300 + estimated_megabytes(run.parameters))


def batch_memory(name, attempt):
    return max(memory(run, attempt) for run in BATCHES[name])


make_rule(
    "simulate",
    call=f"{SIMULATED}:simulate",
    shows="simulations/{name}",
    script_name="simulate",
    priority=1,  # with all that the verdicts wait for: what is only drawn fills the cores at the end
    megabytes=lambda wildcards, attempt: memory(RUNS[wildcards.name], attempt),
    loads=lambda wildcards: plugins(RUNS[wildcards.name].parameters),
    parameters=lambda wildcards: RUNS[wildcards.name].parameters.to_dict(),
    message="Simulation {wildcards.name}",
)

make_rule(
    "batch",
    call="nucleation.patch.batches:table",
    shows="batches/{name}",
    script_name="simulate",
    priority=1,
    megabytes=lambda wildcards, attempt: batch_memory(wildcards.name, attempt),
    loads=lambda wildcards: [SIMULATED, *laws_of(BATCHES[wildcards.name])],
    runs=lambda wildcards: as_dicts(BATCHES[wildcards.name]),
    settings=asdict(settings.extraction),
    measure=lambda wildcards: settings.studies[BATCHES[wildcards.name][0].study].measure,
    message="Simulations {wildcards.name}",
)

# Studies take turns: two runs at once on the paper's mesh, which no cache holds, take a fifth longer.
_batched = [name for name, runs in BATCHES.items() if runs[0].study not in TABLED]
_batched.sort(key=lambda name: int(name.rpartition("-")[2]), reverse=True)
for _turn, _name in enumerate(_batched):

    rule:
        name:
            f"simulate_{_name.replace('-', '_')}"
        output:
            [task.link for task in together("simulate", BATCHES[_name], f"batches/{_name}")],
        log:
            f"{RESULTS}/logs/batches/{_name}.log",
        priority: 2 + _turn  # they take longest
        group:
            "batches"
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
make_rule(
    "extract",
    call="nucleation.analysis.lengths:gather",
    shows="lengths/{name}",
    constraint=one_of(study for study in settings.studies if study not in TABLED),
    priority=1,
    local=True,
    inputs={"simulations": lambda wildcards: simulations(wildcards.name)},
    runs=lambda wildcards: as_dicts(settings.runs_of(wildcards.name)),
    settings=asdict(settings.extraction),
    message="Critical lengths of the study {wildcards.name}",
)

make_rule(
    "join_batches",
    call="nucleation.patch.batches:of_study",
    shows="lengths/{name}",
    constraint=one_of(TABLED),
    local=True,
    inputs={"tables": lambda wildcards: made_by_jobs(wildcards.name)},
    ids=lambda wildcards: [run.id for run in settings.runs_of(wildcards.name)],
    message="Critical lengths of the study {wildcards.name}",
)

make_rule(
    "gather_lengths",
    call="nucleation.analysis.lengths:of_studies",
    shows="lengths",
    local=True,
    inputs={"tables": needed(lambda wildcards: lengths_of(*SHARED), "study with table: lengths")},
    message="Critical lengths of the studies " + ", ".join(SHARED),
)
