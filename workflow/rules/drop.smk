# What the length at the drop means (docs/drop.md): the role `drop`, of declared strengths, kinds and
# seeds, and the law that predicts it from the modes of the runs with the role `quiet`.
DROP = f"{RESULTS}/drop.nc"


@functools.cache
def mode(id):
    """The oscillating mode along one quiet simulation."""
    return of_simulation("modes", id, "mode.py")


moded = run_of_key(mode, "mode of")
FLOORS = settings.studies_for("paper", HOPPING)
"""Studies of quiet runs, whose drops say how noisy their meshes are."""


def fault(run):
    """What sets the faults of quiet runs apart."""
    return run.parameters.geometry.height, run.parameters.friction.evolution


def floor_runs():
    """The runs whose modes say how noisy meshes are: of the faults that have several."""
    faults = {fault(run) for run in settings.runs_for(HOPPING)}
    return [run for run in settings.runs_for("quiet") if fault(run) in faults]


def floor_modes(wildcards):
    return [mode(run.id) for run in floor_runs()]


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


def modes(wildcards):
    return [mode(run.id) for run in settings.runs_for("quiet")]


rule gather_drop:
    input:
        drops=needed([study_lengths(s) for s in settings.studies_for("drop")], "study with role: drop"),
        modes=needed(modes, "study with role: quiet"),
        quiet=[study_lengths(study) for study in FLOORS],
    output:
        dataset=DROP,
        table=f"{RESULTS}/drop.csv",
    log:
        f"{RESULTS}/logs/drop.log",
    params:
        **made_by("gather_drop.py", laws_of(settings.runs_for("quiet"))),
    message:
        "Drops, and the law of the drop"
    script:
        "../scripts/gather_drop.py"


rule gather_floors:
    input:
        modes=needed(floor_modes, f"fault with the role {HOPPING} and the role quiet"),
        quiet=[study_lengths(study) for study in FLOORS],
    output:
        dataset=f"{RESULTS}/floors.nc",
        table=f"{RESULTS}/floors.csv",
    log:
        f"{RESULTS}/logs/floors.log",
    params:
        **made_by("gather_floors.py", laws_of(settings.runs_for("quiet"))),
    message:
        "Noise of meshes and steps"
    script:
        "../scripts/gather_floors.py"


localrules:
    floors,


rule floors:
    """How noisy each mesh is with its steps, as a declared strength."""
    input:
        rules.gather_floors.output,
        floor_modes,
        [simulation(run.id) for run in floor_runs()],
        measured(*FLOORS),
    message:
        "Noise of meshes and steps is in {input[1]}"
