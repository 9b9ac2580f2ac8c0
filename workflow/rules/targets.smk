# Targets with names. Every file is a target as well: results/figures/figure_3.pdf.
def shared(files):
    """An input function for files of the studies that share lengths.csv."""
    return needed(lambda: files([*filter(is_usable, SHARED)]), "study with table: lengths")


def of_studies(names):
    """The tables and figures of some studies."""
    names = list(names)
    figures = [
        f"{RESULTS}/figures/study_{name}.{kind}" for name in names for kind in ("png", "pdf")
    ]
    tables = [path.replace(".nc", ".csv") for path in lengths_of(*names)]
    return figures + tables


OWN_STUDIES = [study for study in SHARED if study not in CLAIMED]
"""Studies that share lengths.csv, except those that claims are about."""
DRAWABLE = figures.drawable({study.role for study in settings.studies.values()})
if DEFAULT != "paper":  # the paper's figures are of the paper's runs
    DRAWABLE = [name for name in DRAWABLE if name not in figures.PAPERS]


rule simulations:
    """The simulations of all studies that share lengths.csv"""
    input:
        shared(lambda names: batches(runs_in(*names))),


rule article:
    """The replication as a short article, with the paper's figures"""
    input:
        rules.write_article.output,
        rules.claims.output,
        [f"{RESULTS}/figures/{name}.png" for name in PAPERS_FIGURES],


rule replication:
    """The article with figures of L_s, drop and map"""
    input:
        rules.article.input,
        rules.write_replication.output,
        [f"{RESULTS}/figures/{name}.png" for name in FIGURES_BEYOND],


rule figures:
    """Every figure for which there are studies; make report shows them on one page"""
    input:
        [f"{RESULTS}/figures/{name}.png" for name in DRAWABLE],
        lambda wildcards: of_studies(filter(is_usable, OWN_STUDIES)),
        rules.lengths.output if SHARED else [],
        [f"{RESULTS}/tables/claims.csv"] if DEFAULT == "paper" else [],


rule figure_studies:
    """A figure of each study that shares lengths.csv"""
    input:
        shared(of_studies),


for study in settings.studies:

    rule figure_study:
        """The figure of one study"""
        name:
            f"figure_study_{study}"
        input:
            f"{RESULTS}/figures/study_{study}.png",


rule pairs:
    """Two deformable bodies: lengths over the theory of the same pair, and verdicts"""
    input:
        rules.gather_pairs.output,
        rules.evaluate_pairs.output,
        rules.pair_modes.output,


rule patch_convergence:
    """Lengths at which patches become unstable on refined meshes"""
    input:
        f"{RESULTS}/patch_convergence.csv",


rule blind:
    """Blind faults: predictions, simulations, coverage and figure"""
    input:
        rules.gather_blind.output,
        rules.blind_coverage.output,
        rules.figure_blind.output,


# Checks of the results; they make no result.
rule check:
    """List results that are stale, incomplete, damaged or foreign"""
    log:
        f"{RESULTS}/logs/check.log",
    localrule: True
    params:
        results=lambda wildcards: recipe.results,
        expected=lambda wildcards: recipe.write_expected(of_studies(settings.studies), checks=True),
    shell:
        f"({PYTHON} -m replication.pipeline.check check {{params.results:q}} {{params.expected:q}})"
        " | tee {log:q} || true"


rule prune:
    """List results that are not in use; PRUNE=yes in the environment removes them"""
    log:
        f"{RESULTS}/logs/prune.log",
    localrule: True
    params:
        results=lambda wildcards: recipe.results,
        expected=lambda wildcards: recipe.write_expected(of_studies(settings.studies)),
    shell:
        f"({PYTHON} -m replication.pipeline.check prune {{params.results:q}} {{params.expected:q}})"
        " | tee {log:q} || true"
