# Every quantitative statement of the paper with our number and a verdict (docs/claims.md), and the
# article that tells of them. Both stand on the paper's runs and the converged ones; claims about
# runs that the configuration does not have can't be checked, and say so.
rule evaluate_claims:
    input:
        theory=only("theory"),
        dispersion=only("dispersion"),
        lengths=lambda wildcards: lengths_of(*CLAIMED),
        simulations=lambda wildcards: simulations(*CLAIMED),
        longer=lambda wildcards: simulations_of(BLOCKS),
        patches=lambda wildcards: patches(*in_role(JUDGED)),
    output:
        link("tables/claims", "json"),
    log:
        log("tables/claims"),
    threads: 1
    params:
        **CONFIGURED("material", "friction", "loading"),
        call="nucleation.claims.evaluation:of_paper",
        loads=sorted({*plugins(settings.base), *EVOLUTIONS}),
        interface=asdict(settings.main_text_interface),
        settings=asdict(settings.extraction),
        ids=[run.id for run in runs_in(*CLAIMED)],
        longer_runs=[{**run, "role": LONGER} for run in as_dicts(BLOCKS)],
        patch_ids=[run.id for run in patched_runs(*in_role(JUDGED))],
    message:
        "Claims of the paper, our numbers and the verdicts"
    script:
        STEP


# What the paper's theory says of two bodies, by simulations: verdicts of their own, for which
# those of `claims`, and so `make paper`, do not wait.
rule evaluate_pairs:
    input:
        pairs=only("gather_pairs"),
        modes=only("pair_modes"),
    output:
        link("tables/claims_pairs", "md"),
    log:
        log("tables/claims_pairs"),
    params:
        call="nucleation.claims.evaluation:of_pairs",
    message:
        "Claims on two bodies, by simulations"
    script:
        STEP


# The same with the figures that come after it, on paper.
rule print_article:
    input:
        template=str(Path(BASE, "docs", "article.md.in")),
        citation=str(Path(BASE, "CITATION.cff")),
        claims=only("evaluate_claims"),
        lengths=lambda wildcards: lengths_of(*CLAIMED),
        figures=lambda wildcards: [steps(f"draw_{name}") for name in PRINTED],
    output:
        link("replication", "pdf"),
    log:
        log("replication"),
    params:
        call="nucleation.claims.printing:write",
        names=lambda wildcards: PRINTED,
    message:
        "Article on the replication as PDF and LaTeX"
    script:
        STEP


rule write_article:
    input:
        template=str(Path(BASE, "docs", "article.md.in")),
        claims=only("evaluate_claims"),
        lengths=lambda wildcards: lengths_of(*CLAIMED),
    output:
        link("article", "md"),
    log:
        log("article"),
    params:
        call="nucleation.claims.evaluation:write_article",
    message:
        "Article on the replication, its numbers from the results"
    script:
        STEP
