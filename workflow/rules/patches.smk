# Beyond the paper: the linear stability of each simulation's own creeping patch, and twin runs
# that confirm it.
make_rule(
    "patch",
    call="nucleation.patch.growth:follow_patch",
    shows="patches/{name}",
    priority=1,
    inputs={"simulation": lambda wildcards: steps("simulate", wildcards.name)},
    loads=lambda wildcards: plugins(RUNS[wildcards.name].parameters),
    settings=asdict(settings.extraction),
    message="Stability of the creeping patch of {wildcards.name}",
)

# Each takes a fifth of a second, a job more than one: those of a study are made in one.
for _study in PATCHED_TOGETHER:

    rule:
        name:
            f"patches_{_study}"
        input:
            simulations=lambda wildcards, study=_study: simulations_of(patched_runs(study)),
        output:
            [task.link for task in together("patch", patched_runs(_study), f"patches-{_study}")],
        log:
            f"{RESULTS}/logs/patches/{_study}.log",
        priority: 1
        group:
            "patches"
        params:
            each=together("patch", patched_runs(_study), f"patches-{_study}"),
        message:
            f"Stability of the creeping patches of the study {_study}"
        script:
            "../scripts/step.py"


make_rule(
    "gather_patches",
    call="nucleation.patch.tables:gather_stability",
    shows="{name}",
    constraint="|".join(PATCH_TABLES),
    local=True,
    inputs={
        "patches": needed(
            lambda wildcards: patches(*PATCH_TABLES[wildcards.name]),
            "study with role: paper, converged or patch_convergence",
        ),
    },
    runs=lambda wildcards: as_dicts(patched_runs(*PATCH_TABLES[wildcards.name])),
    message="Patch lengths at which growth begins: {wildcards.name}",
)

make_rule(
    "twin",
    call="nucleation.patch.twins:of_run",
    shows="twins/{name}",
    megabytes=lambda wildcards, attempt: 2 * memory(RUNS[wildcards.name], attempt),
    loads=lambda wildcards: plugins(RUNS[wildcards.name].parameters),
    run=lambda wildcards: RUNS[wildcards.name].to_dict(),
    settings=asdict(settings.extraction),
    message="Twin runs of {wildcards.name}",
)

make_rule(
    "gather_twins",
    call="nucleation.patch.tables:gather_twins",
    shows="twin_runs",
    local=True,
    inputs={"twins": lambda wildcards: of_runs("twin", runs_for("twin_runs"))},
    runs=as_dicts(runs_for("twin_runs")),
    message="Growth of kicks in twin runs",
)
