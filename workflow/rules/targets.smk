# What users ask for. A target needs results and all that these are made of; its own job, which takes
# no time and always runs, lays links to them under plain names (docs/reuse.md).
PAPERS_FIGURES = ["figure_1", "figure_2", "figure_3", "figure_s1", "figure_s2"]
PRINTED = [*PAPERS_FIGURES, "figure_patch_stability", "figure_drop", "figure_map"]


def drawn(name):
    return [steps(f"draw_{name}")]


def article():
    found = [steps("write_article"), steps("evaluate_claims")]
    return [*found, *(steps(f"draw_{name}") for name in PAPERS_FIGURES)]


def of_study(name):
    return [steps("draw_study", name), *lengths_of(name)]


TARGETS = {
    "paper": (
        "Every figure, table and verdict of the paper.",
        lambda: [*article(), steps("write_table_s1"), steps("gather_lengths")],
    ),
    "studies": (
        "Tables and figures of all studies.",
        lambda: [
            *(path for study in settings.studies for path in of_study(study)),
            *([steps("gather_lengths")] if SHARED else []),
        ],
    ),
    "simulations": (
        "The simulations of the studies that share lengths.csv.",
        lambda: needed(lambda _: made_by_jobs(*SHARED), "study with table: lengths")(None),
    ),
    "lengths": ("Onset and critical length of each of them.", lambda: [steps("gather_lengths")]),
    "claims": ("A verdict on every statement of the paper.", lambda: [steps("evaluate_claims")]),
    "article": ("The replication as a short article.", article),
    "replication": (
        "The article with figures of L_s, drop and map: PDF, LaTeX and Markdown.",
        lambda: [*article(), steps("print_article")],
    ),
    "table_s1": ("Table S1: parameters of the friction law.", lambda: [steps("write_table_s1")]),
    **{
        name: (f"{FIGURES[name].title}.", lambda name=name: drawn(name))
        for name in [*DRAWN, "animation"]
    },
    "figure_studies": (
        "A figure of each study that shares lengths.csv.",
        lambda: needed(
            lambda _: [path for study in SHARED for path in of_study(study)],
            "study with table: lengths",
        )(None),
    ),
    **{
        f"figure_study_{study}": (
            f"Figure of the study {study}.",
            lambda study=study: of_study(study),
        )
        for study in settings.studies
    },
    "pairs": (
        "Two deformable bodies: lengths over the theory of the own far sides, and verdicts.",
        lambda: [steps("gather_pairs"), steps("evaluate_pairs"), steps("pair_modes")],
    ),
    "floors": (
        "How noisy each mesh is with its steps, as a declared strength.",
        lambda: [steps("gather_floors")],
    ),
    "figure_laboratory": (
        "Laboratory faults: lengths observed and computed.",
        lambda: [*drawn("figure_laboratory"), steps("gather_laboratory")],
    ),
    "patch_convergence": (
        "Where patches turn unstable on refined meshes.",
        lambda: [steps("gather_patches", "patch_convergence")],
    ),
    "figure_crosscheck": (
        "The figure of both solvers.",
        lambda: [steps("draw_figure_crosscheck"), steps("compare_crosscheck")],
    ),
    "crosscheck": (
        "The same runs by an independent solver.",
        lambda: [steps("draw_figure_crosscheck"), steps("compare_crosscheck")],
    ),
    "report": ("Everything on one page, results/report.html.", lambda: [steps("write_report")]),
}
"""What each target is for, and the results it leads to; `steps.behind` adds what these stand on."""

if in_role("patch_convergence"):
    TARGETS["figure_patch_stability"] = (
        TARGETS["figure_patch_stability"][0],
        lambda: [*drawn("figure_patch_stability"), steps("gather_patches", "patch_convergence")],
    )


@functools.cache
def wanted(target):
    """All results that a target leads to, by path."""
    return steps.behind(TARGETS[target][1]())


def shown(target):
    """Names and keys of what a target shows, the results it is for first."""
    named = {made.shown: made.key for made in wanted(target).values()}
    others = {name: key for key in named.values() for name in sorted(steps.names[key])}
    return [*(named | others).items()]


def everything(wildcards):
    """Names and keys of all results that any target can lead to."""
    found = {}
    for target in TARGETS:
        try:
            found |= dict(shown(target))
            found |= dict(batched_simulations(wanted(target)))
        except WorkflowError:
            pass  # the configuration lacks what this target needs
    return found


# Questions about results, which nothing is made for; `targets` says what there is to ask for.
for _name in ("check", "prune", "targets"):

    rule:
        name:
            _name
        localrule: True
        params:
            asked=_name,
            results=RESULTS,
            expected=everything if _name != "targets" else {},
            targets=lambda wildcards: {name: text for name, (text, _) in TARGETS.items()},
        message:
            f"{_name} of {RESULTS}"
        script:
            "../scripts/check.py"
