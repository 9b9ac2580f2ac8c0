# Beyond the paper: the linear stability of each simulation's own creeping patch.
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
