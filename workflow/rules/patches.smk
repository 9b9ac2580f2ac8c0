# Beyond the paper: the linear stability of each simulation's own creeping patch.
PATCHES = f"{RESULTS}/patch_stability.nc"


def patches():
    return [f"{RESULTS}/patches/{run.id}.nc" for run in settings.runs_of("paper")]


rule patch:
    input:
        simulation("{id}"),
    output:
        f"{RESULTS}/patches/{{id}}.nc",
    params:
        extraction=asdict(settings.extraction),
        digest=digest("nucleation.patch_stability"),
    message:
        "Stability of the creeping patch of {wildcards.id}"
    script:
        "../scripts/patch.py"


rule gather_patches:
    input:
        patches(),
    output:
        dataset=PATCHES,
        table=f"{RESULTS}/patch_stability.csv",
    params:
        runs=[run.to_dict() for run in settings.runs_of("paper")],
        digest=digest("nucleation.patch_stability"),
    message:
        "Patch lengths at which growth begins"
    script:
        "../scripts/gather_patches.py"


rule draw_figure_patch_stability:
    input:
        lengths=study_lengths("paper"),
        table=PATCHES,
        patches=patches(),
    output:
        figure("figure_patch_stability"),
    params:
        digest=drawing_digest("figure_patch_stability"),
    message:
        "Growth of the frozen patch, and the length at which it begins"
    script:
        "../scripts/figure_patch_stability.py"


rule figure_patch_stability:
    input:
        rules.draw_figure_patch_stability.output,
        patches(),
        simulations("paper"),
    message:
        "Stability of the patches is in {input[0]} and {PATCHES}"
