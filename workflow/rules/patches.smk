# Beyond the paper: the linear stability of each simulation's own creeping patch, and twin runs that
# confirm it. The tables leave out what the configuration has no studies for.
PATCHES = f"{RESULTS}/patch_stability.nc"
TWINS = f"{RESULTS}/twin_runs.nc"
PATCH_TABLES = {
    "patch_stability": settings.studies_for("paper", "converged"),
    "patch_convergence": settings.studies_for("converged", "patch_convergence"),
}
"""Tables of patches by the studies in them."""


def of_simulation(kind, id, script):
    """What a script reads from one simulation by the settings of extraction."""
    parameters = {"extraction": asdict(settings.extraction)}
    return keyed(kind, id, script, parameters, {"": [simulation(id)]}, plugins(RUNS[id].parameters))


@functools.cache
def patch(id):
    """The stability of one simulation's patch."""
    return of_simulation("patches", id, "patch.py")


@functools.cache
def twin(id):
    """The twin runs of one run."""
    parameters = {"run": RUNS[id].to_dict(), "extraction": asdict(settings.extraction)}
    return keyed("twins", id, "twin.py", parameters, modules=plugins(RUNS[id].parameters))


def patched_runs(*studies):
    """The runs whose patches are followed: of each fault the first realisation."""
    return first_realisations(runs_in(*studies))


def patches(*studies):
    return [patch(run.id) for run in patched_runs(*studies)]


patched, twinned = run_of_key(patch, "patch of"), run_of_key(twin, "twins of")


def frozen(table):
    """A table of patches, with the patches and simulations in it."""
    studies = PATCH_TABLES[table]
    behind = [simulation(run.id) for run in patched_runs(*studies)]
    return [*with_csv(f"{RESULTS}/{table}.nc"), *patches(*studies), *behind]


def twins():
    return [twin(run.id) for run in settings.runs_for("twin_runs")]


rule patch:
    input:
        lambda wildcards: simulation(patched(wildcards).id),
    output:
        place_of("patches"),
    log:
        f"{RESULTS}/logs/patch/{{name}}.{{key}}.log",
    priority: 1
    params:
        **made_by("patch.py", lambda wildcards: plugins(patched(wildcards).parameters)),
        extraction=asdict(settings.extraction),
    message:
        "Stability of the creeping patch of {wildcards.name}"
    script:
        "../scripts/patch.py"


# Each takes a fifth of a second, a job more than one: those of a study are made in one.
TOGETHER = {
    f"patches_{study.replace('-', '_')}": patched_runs(study)
    for study in dict.fromkeys([*sum(PATCH_TABLES.values(), []), *PAIR_STUDIES])
    if len(patched_runs(study)) > 1
}
for _name, _runs in TOGETHER.items():

    rule:
        name:
            _name
        input:
            [simulation(run.id) for run in _runs],
        output:
            # kept where they are already there: the job makes what is missing
            [update(patch(run.id)) for run in _runs],
        log:
            f"{RESULTS}/logs/patch/{_name}.log",
        priority: 1
        group:
            grouped_like("patch")
        params:
            **made_by("patch.py", laws_of(_runs)),
            extraction=asdict(settings.extraction),
            places=[(patch(run.id), code_of("patch.py", run)) for run in _runs],
        message:
            f"Stability of the creeping patches of the study {_runs[0].study}"
        script:
            "../scripts/patch.py"


workflow.ruleorder(*TOGETHER, "patch")


rule gather_patches:
    input:
        needed(
            lambda wildcards: patches(*PATCH_TABLES[wildcards.table]),
            "study with role: paper, converged or patch_convergence",
        ),
    output:
        dataset=f"{RESULTS}/{{table}}.nc",
        table=f"{RESULTS}/{{table}}.csv",
    log:
        f"{RESULTS}/logs/{{table}}.log",
    wildcard_constraints:
        table="|".join(PATCH_TABLES),
    params:
        **made_by("gather_patches.py"),
        runs=lambda wildcards: [
            run.to_dict() for run in patched_runs(*PATCH_TABLES[wildcards.table])
        ],
    message:
        "Patch lengths at which growth begins: {wildcards.table}"
    script:
        "../scripts/gather_patches.py"


rule twin:
    output:
        place_of("twins"),
    log:
        f"{RESULTS}/logs/twin/{{name}}.{{key}}.log",
    threads: 1
    resources:
        mem_mb=lambda wildcards, attempt: 2 * memory(twinned(wildcards), attempt),
        runtime=ceil(settings.limits.runtime),
    params:
        **made_by("twin.py", lambda wildcards: plugins(twinned(wildcards).parameters)),
        run=lambda wildcards: twinned(wildcards).to_dict(),
        extraction=asdict(settings.extraction),
    message:
        "Twin runs of {wildcards.name}"
    script:
        "../scripts/twin.py"


rule gather_twins:
    input:
        twins(),
    output:
        dataset=TWINS,
        table=f"{RESULTS}/twin_runs.csv",
    log:
        f"{RESULTS}/logs/twin_runs.log",
    params:
        **made_by("gather_twins.py"),
        runs=[run.to_dict() for run in settings.runs_for("twin_runs")],
    message:
        "Growth of kicks in twin runs"
    script:
        "../scripts/gather_twins.py"
