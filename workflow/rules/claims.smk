# Every quantitative statement of the paper with our number and a verdict (docs/claims.md), and the
# article that tells of them. Both stand on the paper's runs and the converged ones; claims about
# runs that the configuration does not have can't be checked, and say so.
from nucleation.claims.evidence import JUDGED, LONGER, PAPERS

CLAIMS = f"{RESULTS}/claims.json"
ARTICLE = f"{RESULTS}/article.md"
TEMPLATE = Path(BASE, "docs", "article.md.in")
CLAIMED = [study for study in (PAPERS, JUDGED) if study in settings.studies]
"""Studies that claims are about."""
IN_BLOCKS = ("length", "n_x", "time_after_event")
"""What may differ where the block's length is varied."""


def longer():
    """Runs whose block is longer than another's with all else the same, and the others."""
    alike = {}
    for run in runs_in(LONGER):
        mark = {name: value for name, value in run.given.items() if name not in IN_BLOCKS}
        alike.setdefault(repr(sorted(mark.items())), []).append(run)
    pairs = [runs for runs in alike.values()
             if len({run.parameters.geometry.length for run in runs}) > 1]  # fmt: skip
    return [run for runs in pairs for run in runs]


localrules:
    claims,
    article,


rule evaluate_claims:
    input:
        theory=THEORY,
        dispersion=DISPERSION,
        lengths=[study_lengths(study) for study in CLAIMED],
        simulations=simulations(*CLAIMED),
        longer=[simulation(run.id) for run in longer()],
        patches=patches(JUDGED),
    output:
        json=CLAIMS,
        csv=f"{RESULTS}/tables/claims.csv",
        markdown=f"{RESULTS}/tables/claims.md",
    log:
        f"{RESULTS}/logs/claims.log",
    threads: 1
    params:
        **made_by("claims.py", [*plugins(settings.base), *EVOLUTIONS]),
        material=asdict(settings.base.material),
        friction=asdict(settings.base.friction),
        loading=asdict(settings.base.loading),
        main_text_interface=asdict(settings.main_text_interface),
        extraction=asdict(settings.extraction),
        ids=[run.id for run in runs_in(*CLAIMED)],
        longer=[run.to_dict() for run in longer()],
        patch_ids=[run.id for run in patched_runs(JUDGED)],
    message:
        "Claims of the paper, our numbers and the verdicts"
    script:
        "../scripts/claims.py"


rule write_article:
    input:
        claims=CLAIMS,
        lengths=[study_lengths(study) for study in CLAIMED],
    output:
        ARTICLE,
    log:
        f"{RESULTS}/logs/article.log",
    params:
        **made_by("article.py"),
        template=lambda wildcards: TEMPLATE.read_text("utf-8"),
    message:
        "Article on the replication, its numbers from the results"
    script:
        "../scripts/article.py"


rule claims:
    """A verdict on every statement of the paper."""
    input:
        rules.evaluate_claims.output,
        THEORY,
        with_csv(DISPERSION),
        measured(*CLAIMED),
        [simulation(run.id) for run in longer()],
        patches(JUDGED),
    message:
        "Claims and verdicts are in {input[0]}, {input[1]} and {input[2]}"


rule article:
    """The replication as a short article."""
    input:
        ARTICLE,
        rules.claims.input,
        rules.figure_1.input,
        rules.figure_2.input,
        rules.figure_3.input,
        rules.figure_s1.input,
        rules.figure_s2.input,
    message:
        "The article is in {input[0]}"
