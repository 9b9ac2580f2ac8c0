# Beyond the paper: the linear stability of each simulation's own creeping patch, twin runs that
# confirm it, the modes of quiet runs, and hops of the front over nodes.
rule patch:
    input:
        simulation=lambda wildcards: steps("simulate", wildcards.name),
    output:
        link("patches/{name}"),
    log:
        log("patches/{name}"),
    priority: 1
    params:
        call="nucleation.patch.growth:follow_patch",
        loads=lambda wildcards: plugins(RUNS[wildcards.name].parameters),
        settings=asdict(settings.extraction),
    message:
        "Stability of the creeping patch of {wildcards.name}"
    script:
        STEP


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
            STEP


rule gather_patches:
    input:
        patches=needed(
            lambda wildcards: patches(*PATCH_TABLES[wildcards.name]),
            "study with role: paper, converged or patch_convergence",
        ),
    output:
        link("{name}"),
    log:
        log("{name}"),
    wildcard_constraints:
        name="|".join(PATCH_TABLES),
    params:
        call="nucleation.patch.tables:stability_files",
        runs=lambda wildcards: as_dicts(patched_runs(*PATCH_TABLES[wildcards.name])),
    message:
        "Patch lengths at which growth begins: {wildcards.name}"
    script:
        STEP


rule twin:
    output:
        link("twins/{name}"),
    log:
        log("twins/{name}"),
    threads: 1
    resources:
        mem_mb=lambda wildcards, attempt: 2 * memory(RUNS[wildcards.name], attempt),
        runtime=ceil(settings.limits.runtime),
    params:
        call="nucleation.patch.twins:of_run",
        loads=lambda wildcards: plugins(RUNS[wildcards.name].parameters),
        run=lambda wildcards: RUNS[wildcards.name].to_dict(),
        settings=asdict(settings.extraction),
    message:
        "Twin runs of {wildcards.name}"
    script:
        STEP


rule gather_twins:
    input:
        twins=lambda wildcards: twins(),
    output:
        link("twin_runs"),
    log:
        log("twin_runs"),
    params:
        call="nucleation.patch.tables:twin_files",
        runs=as_dicts(runs_for("twin_runs")),
    message:
        "Growth of kicks in twin runs"
    script:
        STEP


rule hops:
    input:
        simulation=lambda wildcards: steps("simulate", wildcards.name),
    output:
        link("hops/{name}"),
    log:
        log("hops/{name}"),
    params:
        call="nucleation.patch.hops:follow_hops",
        loads=lambda wildcards: plugins(RUNS[wildcards.name].parameters),
        settings=asdict(settings.extraction),
    message:
        "Hops of the front of {wildcards.name}"
    script:
        STEP


rule mode:
    input:
        simulation=lambda wildcards: steps("simulate", wildcards.name),
    output:
        link("modes/{name}"),
    log:
        log("modes/{name}"),
    threads: 1
    params:
        call="nucleation.patch.mode_history:of_run",
        loads=lambda wildcards: plugins(RUNS[wildcards.name].parameters),
        settings=asdict(settings.extraction),
    message:
        "Mode of the creeping patch of {wildcards.name}"
    script:
        STEP
