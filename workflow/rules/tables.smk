# Tables beyond the paper: each is made of others, of simulations, or of what was read from these.
make_rule(
    "gather_drop",
    call="nucleation.patch.drop_table:gather",
    shows="drop",
    local=True,
    inputs={
        "drops": needed(lambda wildcards: lengths_of(*in_role("drop")), "study with role: drop"),
        "quiet": lambda wildcards: lengths_of(*FLOORS),
    },
    loads=laws_of(runs_for("drop")),
    runs=as_dicts(one_of_each_fault(runs_for("drop"))),
    message="Drops, and the law of the drop",
)

make_rule(
    "gather_floors",
    call="nucleation.patch.drop_table:floors",
    shows="floors",
    local=True,
    inputs={
        "quiet": needed(
            lambda wildcards: lengths_of(*FLOORS) if runs_for("convergence_quiet") else [],
            "study with role: convergence_quiet",
        ),
    },
    loads=laws_of(runs_for("convergence_quiet")),
    runs=as_dicts(one_of_each_fault(runs_for("convergence_quiet"))),
    message="Noise of meshes and steps",
)

make_rule(
    "gather_map",
    call="nucleation.patch.map_table:files",
    shows="map",
    local=True,
    inputs={"lengths": needed(lambda wildcards: table_of("map"), "study with role: map")},
    message="The map of lengths over height and weakening",
)

# Where patches turn unstable by theory, beside where the simulations' own do.
make_rule(
    "gather_patch_theory",
    call="nucleation.patch.theory_table:files",
    shows="patch_theory",
    inputs={
        "tables": needed(
            lambda wildcards: [*lengths_of(*in_role("map", "patch_theory")), *patch_tables()],
            "study with role: converged, pairs, map or patch_theory",
        ),
    },
    loads=laws_of(runs_for(JUDGED, "map", "patch_theory", *PAIR_ROLES)),
    runs=as_dicts(runs_for(JUDGED, "map", "patch_theory", *PAIR_ROLES)),
    message="Lengths of creeping patches by theory",
)

# All studies whose base is deformable in every run.
make_rule(
    "gather_pairs",
    call="nucleation.patch.pairs:gather",
    shows="pairs",
    local=True,
    inputs={
        "simulations": needed(
            lambda wildcards: simulations(*PAIR_STUDIES),
            "study of two deformable bodies, by its role",
        ),
        "patches": lambda wildcards: patches(*PAIR_STUDIES),
    },
    runs=as_dicts(runs_in(*PAIR_STUDIES)),
    settings=asdict(settings.extraction),
    message="Lengths of the patches between two deformable bodies",
)

make_rule(
    "convergence",
    call="nucleation.analysis.convergence:refinement_table",
    shows="convergence",
    inputs={
        "tables": needed(
            lambda wildcards: lengths_of(*CONVERGENCE_STUDIES), "study with role: convergence"
        ),
    },
    message="Critical lengths against mesh and steps",
)

make_rule(
    "sensitivity",
    call="nucleation.analysis.sensitivity:sensitivity_table",
    shows="sensitivity",
    inputs={
        "simulations": needed(
            lambda wildcards: simulations(*in_role("sensitivity")), "study with role: sensitivity"
        ),
    },
    runs=as_dicts(runs_for("sensitivity")),
    settings=asdict(settings.extraction),
    message="Sensitivity of critical lengths",
)

make_rule(
    "gather_literature",
    call="nucleation.analysis.literature:literature_table",
    shows="literature",
    inputs={
        "simulations": needed(
            lambda wildcards: simulations(*in_role("literature")), "study with role: literature"
        ),
    },
    runs=as_dicts(runs_for("literature")),
    message="The literature's lengths, simulated",
)
