# Every quantitative statement of the paper with our number and a verdict (docs/claims.md), and the
# article on them. If the configuration lacks the runs of a claim, its verdict is "cannot be checked".
PAIRED = "two bodies, simulated"
PAPERS_FIGURES = ["figure_1", "figure_2", "figure_3", "figure_s1", "figure_s2"]
FIGURES_BEYOND = ["figure_patch_stability", "figure_drop", "figure_map"]


@functools.cache
def statements():
    """Subjects with their claims, in pairs: a recipe sorts mappings, and tables have the paper's order."""
    subjects = read_yaml(Path(SOURCE, "replication", "claims", "claims.yaml"))
    return [[subject, list(entries.items())] for subject, entries in subjects.items()]


rule claims:
    """A verdict on every statement of the paper"""
    input:
        theory=f"{RESULTS}/theory.nc",
        dispersion=f"{RESULTS}/dispersion.nc",
        lengths=lambda wildcards: lengths_of(*CLAIMED),
        after=lambda wildcards: [*batches(longer()), *patch_batches(*in_role(JUDGED))],
        recipe=recipe("claims"),
    output:
        report(f"{RESULTS}/tables/claims.csv", category="Verdicts"),
        multiext(f"{RESULTS}/tables/claims", ".md", ".json"),
    log:
        f"{RESULTS}/logs/tables/claims.log",
    params:
        call="replication.claims.table:of_paper",
        loads=sorted({*plugins(settings.base.law), *EVOLUTIONS}),
        reads=lambda wildcards: {
            "longer": simulations(longer()),
            "patches": patches(*in_role(JUDGED)),
        },
        statements=lambda wildcards: [own for own in statements() if own[0] != PAIRED],
        settings=asdict(settings.extraction),
        longer_runs=lambda wildcards: [{**run, "role": LONGER} for run in as_dicts(longer())],
        patch_ids=lambda wildcards: [run.id for run in patched_runs(*in_role(JUDGED))],
        base=settings.base.to_dict(),
    shell:
        JOB


# The paper's theory of two bodies, compared with simulations. These verdicts are separate, so that
# `claims` and `make paper` need not wait for them.
rule evaluate_pairs:
    """Verdicts on the paper's theory of two bodies"""
    input:
        pairs=f"{RESULTS}/pairs.nc",
        modes=f"{RESULTS}/pair_modes.nc",
        recipe=recipe("evaluate_pairs"),
    output:
        multiext(f"{RESULTS}/tables/claims_pairs", ".csv", ".md"),
    log:
        f"{RESULTS}/logs/tables/claims_pairs.log",
    params:
        call="replication.claims.table:of_pairs",
        statements=lambda wildcards: [own for own in statements() if own[0] == PAIRED],
    shell:
        JOB


rule write_article:
    """The article on the replication, its numbers from the results"""
    input:
        template=ours("docs/article.md.in"),
        claims=f"{RESULTS}/tables/claims.json",
        lengths=lambda wildcards: lengths_of(*CLAIMED),
        recipe=recipe("write_article"),
    output:
        f"{RESULTS}/article.md",
    log:
        f"{RESULTS}/logs/article.log",
    localrule: True
    params:
        call="replication.claims.table:write_article",
    shell:
        JOB


rule write_replication:
    """The article with the figures of L_s, drop and map"""
    input:
        template=ours("docs/article.md.in"),
        claims=f"{RESULTS}/tables/claims.json",
        lengths=lambda wildcards: lengths_of(*CLAIMED),
        recipe=recipe("write_replication"),
    output:
        f"{RESULTS}/replication.md",
    log:
        f"{RESULTS}/logs/replication.log",
    localrule: True
    params:
        call="replication.claims.table:write_article",
        beyond=True,
    shell:
        JOB
