# Simulations that take seconds, many in one job (a study's runs_per_job): one start of Python and one
# job of Snakemake for all of them. Each has its own dataset, made as by the rule `simulate`; the
# batch's is the table of what was measured.
BATCHES = {}
for _run in settings.runs:
    if _run.batch:
        BATCHES.setdefault(_run.batch, []).append(_run)


def laws_of(name):
    """Code that the runs of a batch load by name."""
    return sorted({law for run in BATCHES[name] for law in plugins(run.parameters)})


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
    return keyed("batches", name, "batch.py", batch_parameters(name), modules=laws_of(name))


batched = of_key(batch, "batch", BATCHES)


def batch_parameter(name):
    return lambda wildcards: batch_parameters(batched(wildcards))[name]


def code_of(run):
    return PLANNER.code(script_path("simulate.py"), plugins(run.parameters))


rule batch:
    output:
        place_of("batches"),
    log:
        f"{RESULTS}/logs/batches/{{name}}.{{key}}.log",
    priority: 1
    threads: 1
    resources:
        mem_mb=lambda wildcards, attempt: max(
            memory(run, attempt) for run in BATCHES[batched(wildcards)]
        ),
        runtime=ceil(settings.limits.runtime),
    params:
        **made_by("batch.py", lambda wildcards: laws_of(batched(wildcards))),
        runs=batch_parameter("runs"),
        extraction=batch_parameter("extraction"),
        measure=batch_parameter("measure"),
        places=lambda wildcards: [
            (simulation(run.id), code_of(run)) for run in BATCHES[batched(wildcards)]
        ],
    message:
        "Simulations {wildcards.name}"
    script:
        "../scripts/batch.py"


rule simulations:
    """The simulations of those studies."""
    input:
        needed(made(*SHARED), "study with table: lengths"),
    message:
        f"All simulations are in {RESULTS}/simulations"
