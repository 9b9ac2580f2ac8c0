# Tables beyond the paper: each is made of others, of simulations, or of what was read from these.
rule gather_drop:
    input:
        drops=needed(lambda wildcards: lengths_of(*in_role("drop")), "study with role: drop"),
        quiet=lambda wildcards: lengths_of(*FLOORS),
        modes=needed(lambda wildcards: modes(), "study with role: quiet"),
    output:
        link("drop"),
    log:
        log("drop"),
    params:
        call="nucleation.patch.drop_table:drop_files",
        loads=laws_of(runs_for("quiet")),
    message:
        "Drops, and the law of the drop"
    script:
        STEP


rule gather_floors:
    input:
        quiet=lambda wildcards: lengths_of(*FLOORS),
        modes=needed(
            lambda wildcards: steps.several("mode", [run.id for run in floor_runs()]),
            "fault with the roles convergence_quiet and quiet",
        ),
    output:
        link("floors"),
    log:
        log("floors"),
    params:
        call="nucleation.patch.drop_table:floor_files",
        loads=laws_of(runs_for("quiet")),
    message:
        "Noise of meshes and steps"
    script:
        STEP


rule gather_map:
    input:
        lengths=needed(lambda wildcards: table_of("map"), "study with role: map"),
    output:
        link("map"),
    log:
        log("map"),
    params:
        call="nucleation.patch.map_table:files",
    message:
        "The map of lengths over height and weakening"
    script:
        STEP


# Where patches turn unstable by theory, beside where the simulations' own do.
rule gather_patch_theory:
    input:
        tables=needed(
            lambda wildcards: [*lengths_of(*in_role("map", "patch_theory")), *patch_tables()],
            "study with role: converged, pairs, map or patch_theory",
        ),
    output:
        link("patch_theory"),
    log:
        log("patch_theory"),
    params:
        call="nucleation.patch.theory_table:files",
        loads=laws_of(runs_for(JUDGED, "map", "patch_theory", *PAIR_ROLES)),
        runs=as_dicts(runs_for(JUDGED, "map", "patch_theory", *PAIR_ROLES)),
    message:
        "Lengths of creeping patches by theory"
    script:
        STEP


# All studies whose base is deformable in every run.
rule gather_pairs:
    input:
        simulations=needed(
            lambda wildcards: simulations(*PAIR_STUDIES),
            "study of two deformable bodies, by its role",
        ),
        patches=lambda wildcards: patches(*PAIR_STUDIES),
    output:
        link("pairs"),
    log:
        log("pairs"),
    params:
        call="nucleation.patch.pairs:files",
        runs=as_dicts(runs_in(*PAIR_STUDIES)),
        settings=asdict(settings.extraction),
    message:
        "Lengths of the patches between two deformable bodies"
    script:
        STEP


rule convergence:
    input:
        tables=needed(
            lambda wildcards: lengths_of(*CONVERGENCE_STUDIES), "study with role: convergence"
        ),
    output:
        link("convergence"),
    log:
        log("convergence"),
    params:
        call="nucleation.analysis.convergence:files",
    message:
        "Critical lengths against mesh and steps"
    script:
        STEP


rule sensitivity:
    input:
        simulations=needed(
            lambda wildcards: simulations(*in_role("sensitivity")), "study with role: sensitivity"
        ),
    output:
        link("sensitivity"),
    log:
        log("sensitivity"),
    params:
        call="nucleation.analysis.sensitivity:files",
        runs=as_dicts(runs_for("sensitivity")),
        settings=asdict(settings.extraction),
    message:
        "Sensitivity of critical lengths"
    script:
        STEP


# Published laboratory faults: the lengths observed, and those of the theory where enough was read.
rule gather_laboratory:
    output:
        link("laboratory"),
    log:
        log("laboratory"),
    params:
        call="nucleation.analysis.laboratory:files",
        faults=read_yaml(Path(SOURCE, "nucleation", "analysis", "laboratory.yaml")),
    message:
        "Laboratory faults: lengths observed and computed"
    script:
        STEP
