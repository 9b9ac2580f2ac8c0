# Every quantitative statement of the paper with our number and a verdict (docs/claims.md), and the
# article that tells of them. Both stand on the paper's runs and the converged ones; claims about
# runs that the configuration does not have can't be checked, and say so.
from nucleation.claims.evidence import JUDGED, LONGER, PAPERS

CLAIMS = f"{RESULTS}/claims.json"
ARTICLE = f"{RESULTS}/article.md"
TEMPLATE = Path(BASE, "docs", "article.md.in")
CLAIMED = settings.studies_for(PAPERS, JUDGED)
"""Studies that claims are about."""


def element(run):
    """All that a run is given but for the block's length, of which there is that of an element (m)."""
    given, mesh = run.parameters.to_dict(), run.parameters.mesh
    given["geometry"]["length"] = round(given["geometry"]["length"] / mesh.n_x, 9)
    given["mesh"]["n_x"] = None
    return given


def longer():
    """The runs in longer blocks that differ from one of those judged in nothing else, and these."""
    blocks, judged = ([(element(run), run) for run in settings.runs_for(role)] for role in (LONGER, JUDGED))
    return [run for like, block in blocks for other, base in judged if other == like
            for run in (block, base)]  # fmt: skip


BLOCKS = longer() if settings.runs_for(LONGER) else []


localrules:
    claims,
    article,


rule evaluate_claims:
    input:
        theory=THEORY,
        dispersion=DISPERSION,
        lengths=[study_lengths(study) for study in CLAIMED],
        simulations=simulations(*CLAIMED),
        longer=[simulation(run.id) for run in BLOCKS],
        patches=patches(*settings.studies_for(JUDGED)),
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
        longer=[{**run.to_dict(), "role": LONGER} for run in BLOCKS],
        patch_ids=[run.id for run in patched_runs(*settings.studies_for(JUDGED))],
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
        [simulation(run.id) for run in BLOCKS],
        patches(*settings.studies_for(JUDGED)),
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
