# Simulations that take seconds, many in one job (a study's runs_per_job): one start of Python and one
# job of Snakemake for all of them. Each has its own dataset, made as by the rule `simulate`. Where
# other results are made of these one by one, they are what the job makes; else it is the table of
# what was measured, and Snakemake need not know of thousands of files.
BATCHES = {}
for _run in settings.runs:
    if _run.batch:
        BATCHES.setdefault(_run.batch, []).append(_run)

TABLED = [
    name
    for name, study in settings.studies.items()
    if study.runs_per_job > 1 and not ROLES[study.role].one_by_one
]
"""Studies in batches that are measured by the job that makes them."""


def batch_parameters(name):
    """What a batch's table depends on."""
    return {
        "runs": [run.to_dict() for run in BATCHES[name]],
        "extraction": asdict(settings.extraction),
        "measure": settings.studies[BATCHES[name][0].study].measure,
    }


@functools.cache
def batch(name):
    """The table of the runs of one batch."""
    return keyed(
        "batches", name, "batch.py", batch_parameters(name), modules=laws_of(BATCHES[name])
    )


MEASURED = [name for name, runs in BATCHES.items() if runs[0].study in TABLED]
batched = of_key(batch, "batch", MEASURED)


def batch_parameter(name):
    return lambda wildcards: batch_parameters(batched(wildcards))[name]


def places(name):
    """Where the datasets of a batch belong, and the code that makes each."""
    return [(simulation(run.id), code_of("simulate.py", run)) for run in BATCHES[name]]


def batch_memory(name, attempt):
    return max(memory(run, attempt) for run in BATCHES[name])


rule batch:
    output:
        place_of("batches"),
    log:
        f"{RESULTS}/logs/batches/{{name}}.{{key}}.log",
    priority: 1
    threads: 1
    resources:
        mem_mb=lambda wildcards, attempt: batch_memory(batched(wildcards), attempt),
        runtime=ceil(settings.limits.runtime),
    params:
        **made_by("batch.py", lambda wildcards: laws_of(BATCHES[batched(wildcards)])),
        runs=batch_parameter("runs"),
        extraction=batch_parameter("extraction"),
        measure=batch_parameter("measure"),
        places=lambda wildcards: places(batched(wildcards)),
    message:
        "Simulations {wildcards.name}"
    script:
        "../scripts/batch.py"


SEVERAL = {name: f"simulate_{name.replace('-', '_')}" for name in BATCHES if name not in MEASURED}
for _name in SEVERAL:

    rule:
        name:
            SEVERAL[_name]
        output:
            # kept where they are already there: the job makes what is missing
            [update(path) for path, _ in places(_name)],
        log:
            f"{RESULTS}/logs/batches/{_name}.log",
        priority: 2  # they take longest
        group:
            grouped_like("batch")
        threads: 1
        resources:
            mem_mb=lambda wildcards, attempt, name=_name: batch_memory(name, attempt),
            runtime=ceil(settings.limits.runtime),
        params:
            **made_by("batch.py", laws_of(BATCHES[_name])),
            runs=batch_parameters(_name)["runs"],
            places=places(_name),
        message:
            f"Simulations {_name}"
        script:
            "../scripts/batch.py"


workflow.ruleorder(*SEVERAL.values(), "simulate")


rule simulations:
    """The simulations of those studies."""
    input:
        needed(made(*SHARED), "study with table: lengths"),
    message:
        f"All simulations are in {RESULTS}/simulations"
