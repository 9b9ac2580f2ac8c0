# What users ask for. A target needs results and all that these are made of; its own job, which takes
# no time and always runs, lays links to them under plain names (docs/reuse.md).
PAPERS_FIGURES = ["figure_1", "figure_2", "figure_3", "figure_s1", "figure_s2"]
PRINTED = [*PAPERS_FIGURES, "figure_patch_stability", "figure_drop", "figure_map"]


def made(*rules):
    """A function that gives the results of some rules."""
    return lambda: [steps(rule) for rule in rules]


def of_studies(names):
    return [path for name in names for path in [steps("draw_study", name), *lengths_of(name)]]


def shared(results):
    """A function that gives results of the studies that share lengths.csv."""
    return lambda: needed(lambda _: results(SHARED), "study with table: lengths")(None)


COMPARED = ["draw_figure_crosscheck", "compare_crosscheck"]
ARTICLE = ["write_article", "evaluate_claims", *(f"draw_{name}" for name in PAPERS_FIGURES)]
TARGETS = {
    "paper": (
        "Every figure, table and verdict of the paper.",
        made(*ARTICLE, "write_table_s1", "gather_lengths"),
    ),
    "studies": (
        "Tables and figures of all studies.",
        lambda: of_studies(settings.studies) + made("gather_lengths")() * bool(SHARED),
    ),
    "simulations": (
        "The simulations of the studies that share lengths.csv.",
        shared(lambda studies: made_by_jobs(*studies)),
    ),
    "lengths": ("Onset and critical length of each of them.", made("gather_lengths")),
    "claims": ("A verdict on every statement of the paper.", made("evaluate_claims")),
    "article": ("The replication as a short article.", made(*ARTICLE)),
    "replication": (
        "The article with figures of L_s, drop and map: PDF, LaTeX and Markdown.",
        made(*ARTICLE, "print_article"),
    ),
    "table_s1": ("Table S1: parameters of the friction law.", made("write_table_s1")),
    **{name: (f"{FIGURES[name].title}.", made(f"draw_{name}")) for name in [*DRAWN, "animation"]},
    "figure_studies": ("A figure of each study that shares lengths.csv.", shared(of_studies)),
    **{
        f"figure_study_{study}": (f"Figure of the study {study}.", lambda s=study: of_studies([s]))
        for study in settings.studies
    },
    "pairs": (
        "Two deformable bodies: lengths over the theory of the own far sides, and verdicts.",
        made("gather_pairs", "evaluate_pairs", "pair_modes"),
    ),
    "floors": (
        "How noisy each mesh is with its steps, as a declared strength.",
        made("gather_floors"),
    ),
    "patch_convergence": (
        "Where patches turn unstable on refined meshes.",
        lambda: [steps("gather_patches", "patch_convergence")],
    ),
    "figure_crosscheck": ("The figure of both solvers.", made(*COMPARED)),
    "crosscheck": ("The same runs by an independent solver.", made(*COMPARED)),
    "report": ("Everything on one page, results/report.html.", made("write_report")),
}
"""What each target is for, and the results it leads to; `steps.behind` adds what these stand on."""

if in_role("patch_convergence"):
    _title, _drawn = TARGETS["figure_patch_stability"]
    TARGETS["figure_patch_stability"] = (
        _title,
        lambda: _drawn() + TARGETS["patch_convergence"][1](),
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
