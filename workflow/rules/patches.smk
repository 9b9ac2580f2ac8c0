# Beyond the paper: the linear stability of each simulation's own creeping patch, and twin runs that
# confirm it. The tables leave out what the configuration has no studies for.
PATCHES = f"{RESULTS}/patch_stability.nc"
TWINS = f"{RESULTS}/twin_runs.nc"
PATCH_TABLES = {
    "patch_stability": ("paper", "converged"),
    "patch_convergence": ("converged", "patch_convergence"),
}
"""Tables of patches by the studies in them."""


def patches(*studies):
    return [f"{RESULTS}/patches/{run.id}.nc" for run in runs_in(*studies)]


def frozen(table):
    """A table of patches, with the patches and simulations in it."""
    studies = PATCH_TABLES[table]
    return [*with_csv(f"{RESULTS}/{table}.nc"), *patches(*studies), *simulations(*studies)]


def twins():
    return [f"{RESULTS}/twins/{run.id}.nc" for run in runs_in("twin_runs")]


rule patch:
    input:
        simulation("{id}"),
    output:
        f"{RESULTS}/patches/{{id}}.nc",
    params:
        extraction=asdict(settings.extraction),
        digest=digest("nucleation.patch.growth"),
    message:
        "Stability of the creeping patch of {wildcards.id}"
    script:
        "../scripts/patch.py"


rule gather_patches:
    input:
        needed(
            lambda wildcards: patches(*PATCH_TABLES[wildcards.table]),
            "study paper, converged or patch_convergence",
        ),
    output:
        dataset=f"{RESULTS}/{{table}}.nc",
        table=f"{RESULTS}/{{table}}.csv",
    wildcard_constraints:
        table="|".join(PATCH_TABLES),
    params:
        runs=lambda wildcards: [run.to_dict() for run in runs_in(*PATCH_TABLES[wildcards.table])],
        digest=digest("nucleation.patch.growth"),
    message:
        "Patch lengths at which growth begins: {wildcards.table}"
    script:
        "../scripts/gather_patches.py"


rule twin:
    output:
        f"{RESULTS}/twins/{{id}}.nc",
    params:
        run=lambda wildcards: run_of(wildcards).to_dict(),
        extraction=asdict(settings.extraction),
        digest=digest("nucleation.patch.twins"),
    threads: 1
    resources:
        mem_mb=lambda wildcards, attempt: 2 * memory(wildcards, attempt),
        runtime=ceil(settings.limits.runtime),
    message:
        "Twin runs of {wildcards.id}"
    script:
        "../scripts/twin.py"


rule gather_twins:
    input:
        twins(),
    output:
        dataset=TWINS,
        table=f"{RESULTS}/twin_runs.csv",
    params:
        runs=[run.to_dict() for run in runs_in("twin_runs")],
        digest=digest("nucleation.patch.twins"),
    message:
        "Growth of kicks in twin runs"
    script:
        "../scripts/gather_twins.py"


rule draw_figure_patch_stability:
    input:
        table=PATCHES,
        patches=patches(*PATCH_TABLES["patch_stability"]),
        twins=TWINS,
    output:
        figure("figure_patch_stability"),
    params:
        digest=drawing_digest("figure_patch_stability"),
    message:
        "Growth of the frozen patch, the shape of its mode, and twin runs"
    script:
        "../scripts/figure_patch_stability.py"


rule draw_figure_3_extended:
    input:
        theory=THEORY,
        lengths=LENGTHS,
        table=PATCHES,
    output:
        figure("figure_3_extended"),
    params:
        digest=drawing_digest("figure_3_extended"),
    message:
        "Lengths of the drop and of the patch's stability over those of the theory"
    script:
        "../scripts/figure_3_extended.py"


rule figure_patch_stability:
    input:
        rules.draw_figure_patch_stability.output,
        frozen("patch_stability"),
        frozen("patch_convergence") if runs_in("patch_convergence") else [],
        with_csv(TWINS),
        twins(),
    message:
        "Stability of the patches is in {input[0]} and {PATCHES}"


rule figure_3_extended:
    input:
        rules.draw_figure_3_extended.output,
        THEORY,
        rules.lengths.input,
        frozen("patch_stability"),
    message:
        "Figure 3 with the patches' lengths is in {input[0]}"
