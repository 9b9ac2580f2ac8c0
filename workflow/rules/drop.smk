# What the length at the drop means (docs/drop.md): the study `drop` of declared strengths, kinds and
# seeds, and the law that predicts it from the modes of the quiet runs of the study `quiet`.
DROP = f"{RESULTS}/drop.nc"


@functools.cache
def drop_groups():
    """Runs of the study `drop` by the job that makes them, one after another in one process.

    A run takes seconds, of which a job of its own would take as many to start.
    """
    groups = {}
    for run in runs_in("drop"):
        parameters = run.parameters
        name = (
            f"{parameters.friction.evolution}-H{parameters.geometry.height:g}-"
            f"{parameters.perturbation.kind}-{parameters.perturbation.strength:g}-"
            f"{parameters.mesh.n_x}x{parameters.mesh.n_y}-{parameters.stepping.longest_step:g}"
        )
        groups.setdefault(name, []).append(run)
    return groups


def drop_params(name):
    return {
        "runs": [run.to_dict() for run in drop_groups()[name]],
        "extraction": asdict(settings.extraction),
    }


@functools.cache
def drops(name):
    """Where the runs of one group drop."""
    laws = plugins(drop_groups()[name][0].parameters)
    return keyed("drops", name, "drops.py", drop_params(name), modules=laws)


rule drops:
    output:
        place_of("drops"),
    log:
        f"{RESULTS}/logs/drops/{{name}}.{{key}}.log",
    threads: 1
    resources:
        mem_mb=lambda wildcards, attempt: max(
            memory(run, attempt) for run in drop_groups()[wildcards.name]
        ),
        runtime=ceil(settings.limits.runtime),
    params:
        **made_by(
            "drops.py", lambda wildcards: plugins(drop_groups()[wildcards.name][0].parameters)
        ),
        runs=lambda wildcards: drop_params(wildcards.name)["runs"],
        extraction=asdict(settings.extraction),
    message:
        "Drops of {wildcards.name}"
    script:
        "../scripts/drops.py"


@functools.cache
def mode(id):
    """The oscillating mode along one quiet simulation."""
    return of_simulation("modes", id, "mode.py")


moded = of_key(mode, "mode of")
FLOORS = [study for study in ("paper", HOPPING) if study in settings.studies]
"""Studies of quiet runs, whose drops say how noisy their meshes are."""


rule mode:
    input:
        lambda wildcards: simulation(moded(wildcards).id),
    output:
        place_of("modes"),
    log:
        f"{RESULTS}/logs/mode/{{name}}.{{key}}.log",
    threads: 1
    params:
        **made_by("mode.py", lambda wildcards: plugins(moded(wildcards).parameters)),
        extraction=asdict(settings.extraction),
    message:
        "Mode of the creeping patch of {wildcards.name}"
    script:
        "../scripts/mode.py"


def all_drops(wildcards):
    return [drops(name) for name in drop_groups()]


def modes(wildcards):
    return [mode(run.id) for run in runs_in("quiet")]


rule gather_drop:
    input:
        drops=needed(all_drops, "study drop"),
        modes=needed(modes, "study quiet"),
        quiet=[study_lengths(study) for study in FLOORS],
    output:
        dataset=DROP,
        table=f"{RESULTS}/drop.csv",
    log:
        f"{RESULTS}/logs/drop.log",
    params:
        **made_by("gather_drop.py", EVOLUTIONS),
    message:
        "Drops, and the law of the drop"
    script:
        "../scripts/gather_drop.py"
