# Tables beyond the paper: each is made from other tables or from simulations.
rule gather_drop:
    """Drops, and the law of the drop"""
    input:
        drops=needed(lambda: lengths_of(*in_role("drop")), "study with role: drop"),
        quiet=lambda wildcards: lengths_of(*FLOORS),
        recipe=recipe("gather_drop"),
    output:
        multiext(f"{RESULTS}/drop", ".csv", ".nc"),
    log:
        f"{RESULTS}/logs/drop.log",
    localrule: True
    params:
        call="replication.tables.drops:drop_files",
        loads=lambda wildcards: laws_of(runs_for("drop")),
        runs=lambda wildcards: as_dicts(one_of_each_fault(runs_for("drop"))),
    shell:
        JOB


rule gather_weakening:
    """Drops from weak to strong weakening: simulations and theory"""
    input:
        drops=needed(lambda: lengths_of(*in_role("weakening")), "study with role: weakening"),
        recipe=recipe("gather_weakening"),
    output:
        multiext(f"{RESULTS}/weakening", ".csv", ".nc"),
    log:
        f"{RESULTS}/logs/weakening.log",
    params:
        call="replication.tables.drops:weakening_files",
        loads=lambda wildcards: laws_of(runs_for("weakening")),
        runs=lambda wildcards: as_dicts(one_of_each_fault(runs_for("weakening"))),
    shell:
        JOB


rule other_faults:
    """Drops of faults that the expected drop was not fitted to"""
    input:
        drops=needed(lambda: table_of("other_faults"), "study with role: other_faults"),
        recipe=recipe("other_faults"),
    output:
        multiext(f"{RESULTS}/other_faults", ".csv", ".nc"),
    log:
        f"{RESULTS}/logs/other_faults.log",
    params:
        call="replication.tables.drops:gather_other_faults",
        loads=lambda wildcards: laws_of(runs_for("other_faults")),
        runs=lambda wildcards: as_dicts(first_realisations(runs_for("other_faults"))),
    shell:
        JOB


rule gather_map:
    """The map of lengths over height and weakening"""
    input:
        lengths=needed(lambda: table_of("map"), "study with role: map"),
        recipe=recipe("gather_map"),
    output:
        multiext(f"{RESULTS}/map", ".csv", ".nc"),
    log:
        f"{RESULTS}/logs/map.log",
    localrule: True
    params:
        call="replication.tables.ratios:map_files",
    shell:
        JOB


def compared_with_theory():
    """The runs whose L_s is compared with that of the theory."""
    return runs_for(JUDGED, "map", "patch_theory", *PAIR_ROLES)


rule gather_patch_theory:
    """Lengths of creeping patches: theory and simulations"""
    input:
        tables=needed(
            lambda: [*lengths_of(*in_role("map", "patch_theory")), *patch_tables()],
            "study with role: converged, pairs, map or patch_theory",
        ),
        recipe=recipe("gather_patch_theory"),
    output:
        multiext(f"{RESULTS}/patch_theory", ".csv", ".nc"),
    log:
        f"{RESULTS}/logs/patch_theory.log",
    params:
        call="replication.tables.theory:theory_table",
        loads=lambda wildcards: laws_of(compared_with_theory()),
        runs=lambda wildcards: as_dicts(compared_with_theory()),
    shell:
        JOB


# All studies with a deformable base in every run.
rule gather_pairs:
    """Lengths of the patches between two deformable bodies"""
    input:
        after=needed(
            lambda: [*batches(runs_in(*PAIR_STUDIES)), *patch_batches(*PAIR_STUDIES)],
            "study of two deformable bodies, by its role",
        ),
        recipe=recipe("gather_pairs"),
    output:
        multiext(f"{RESULTS}/pairs", ".csv", ".nc"),
    log:
        f"{RESULTS}/logs/pairs.log",
    localrule: True
    params:
        call="replication.tables.ratios:gather_pairs",
        reads=lambda wildcards: {
            "simulations": simulations(runs_in(*PAIR_STUDIES)),
            "patches": patches(*PAIR_STUDIES),
        },
        runs=lambda wildcards: as_dicts(runs_in(*PAIR_STUDIES)),
        settings=asdict(settings.extraction),
    shell:
        JOB


rule convergence:
    """Critical lengths against mesh and steps"""
    input:
        tables=needed(lambda: lengths_of(*CONVERGENCE_STUDIES), "study with role: convergence"),
        recipe=recipe("convergence"),
    output:
        multiext(f"{RESULTS}/convergence", ".csv", ".nc"),
    log:
        f"{RESULTS}/logs/convergence.log",
    params:
        call="replication.tables.ratios:refinement_table",
    shell:
        JOB


rule gather_literature:
    """The literature's lengths, simulated"""
    input:
        after=needed(lambda: batches(runs_for("literature")), "study with role: literature"),
        recipe=recipe("gather_literature"),
    output:
        multiext(f"{RESULTS}/literature", ".csv", ".nc"),
    log:
        f"{RESULTS}/logs/literature.log",
    params:
        call="replication.tables.literature:literature_table",
        reads=lambda wildcards: {"simulations": simulations(runs_for("literature"))},
        runs=lambda wildcards: as_dicts(runs_for("literature")),
    shell:
        JOB


rule gather_weakening_patches:
    """Weakening patches among strengthening surroundings, beside theory"""
    input:
        after=needed(
            lambda: batches(runs_for("weakening_patches")), "study with role: weakening_patches"
        ),
        recipe=recipe("gather_weakening_patches"),
    output:
        multiext(f"{RESULTS}/weakening_patches", ".csv", ".nc"),
    log:
        f"{RESULTS}/logs/weakening_patches.log",
    params:
        call="replication.tables.weakening_patches:weakening_patches_table",
        loads=lambda wildcards: laws_of(runs_for("weakening_patches")),
        reads=lambda wildcards: {"simulations": simulations(runs_for("weakening_patches"))},
        runs=lambda wildcards: as_dicts(runs_for("weakening_patches")),
    shell:
        JOB


rule patch_outcomes:
    """Widths of weakening patches at which slow slip ends and events begin"""
    input:
        patches=f"{RESULTS}/weakening_patches.nc",
        recipe=recipe("patch_outcomes"),
    output:
        multiext(f"{RESULTS}/patch_outcomes", ".csv", ".nc"),
    log:
        f"{RESULTS}/logs/patch_outcomes.log",
    params:
        call="replication.tables.weakening_patches:patch_outcomes_table",
    message:
        "Widths of weakening patches at which slow slip ends and events begin"
    shell:
        JOB


rule blind_predicted:
    """L of the blind faults by theory alone"""
    input:
        recipe=recipe("blind_predicted"),
    output:
        multiext(f"{RESULTS}/blind_predicted", ".csv", ".nc"),
    log:
        f"{RESULTS}/logs/blind_predicted.log",
    params:
        call="replication.tables.blind:blind_predictions",
        loads=lambda wildcards: laws_of(runs_for("blind")),
        runs=lambda wildcards: as_dicts(first_realisations(runs_for("blind"))),
    shell:
        JOB


rule gather_blind:
    """Drops of the blind faults beside the predictions that were kept before, and today's"""
    input:
        drops=needed(lambda: table_of("blind"), "study with role: blind"),
        predictions=f"{RESULTS}/blind_predicted.nc",
        predicted=ours("results/reference/blind_predicted.csv"),
        recipe=recipe("gather_blind"),
    output:
        multiext(f"{RESULTS}/blind", ".csv", ".nc"),
    log:
        f"{RESULTS}/logs/blind.log",
    params:
        call="replication.tables.blind:blind_files",
        loads=lambda wildcards: laws_of(runs_for("blind")),
        runs=lambda wildcards: as_dicts(first_realisations(runs_for("blind"))),
    shell:
        JOB


rule blind_coverage:
    """Parts of the blind realisations in the predicted ranges, by half and regime"""
    input:
        blind=f"{RESULTS}/blind.nc",
        recipe=recipe("blind_coverage"),
    output:
        f"{RESULTS}/blind_coverage.csv",
    log:
        f"{RESULTS}/logs/blind_coverage.log",
    localrule: True
    params:
        call="replication.tables.blind:coverage_files",
    shell:
        JOB
