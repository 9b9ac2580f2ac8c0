# Beyond the paper: the linear stability of the creeping patch in each simulation. A patch takes a fifth
# of a second, and a job more than a second, so one job makes all patches of a study.
rule follow_patches:
    """Stability of the creeping patches of a study"""
    input:
        after=lambda wildcards: batches(patched_runs(wildcards.study)),
        recipe=recipe("follow_patches"),
    output:
        f"{RESULTS}/patches/{{study}}.json",
    log:
        f"{RESULTS}/logs/patches/{{study}}.log",
    priority: 1
    threads: 2
    params:
        makes=lambda wildcards: patches(wildcards.study),
    shell:
        JOB


rule patch:
    """Stability of one creeping patch, shown under its run's name"""
    input:
        after=lambda wildcards: ancient(patch_batches(study_of(wildcards.name))),
        recipe=recipe("patch"),
    output:
        f"{RESULTS}/patches/{{name}}.nc",
    log:
        f"{RESULTS}/logs/patches/{{name}}.log",
    localrule: True
    params:
        call="nucleation.extraction.growth:follow_patch",
        loads=lambda wildcards: plugins(run_of(wildcards.name).run.law),
        reads=lambda wildcards: {"simulation": simulations([run_of(wildcards.name)])[0]},
        settings=asdict(settings.extraction),
    shell:
        JOB


rule gather_patches:
    """Patch lengths at which growth begins"""
    input:
        after=lambda wildcards: needed(
            lambda: patch_batches(*PATCH_TABLES[wildcards.table]),
            "study with role: paper, converged or patch_convergence",
        )(wildcards),
        recipe=recipe("gather_patches"),
    output:
        multiext(f"{RESULTS}/{{table,{one_of(PATCH_TABLES)}}}", ".csv", ".nc"),
    log:
        f"{RESULTS}/logs/{{table}}.log",
    localrule: True
    params:
        call="replication.tables.ratios:gather_stability",
        reads=lambda wildcards: {"patches": patches(*PATCH_TABLES[wildcards.table])},
        runs=lambda wildcards: as_dicts(patched_runs(*PATCH_TABLES[wildcards.table])),
    shell:
        JOB
