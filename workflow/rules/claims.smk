STATED = read_yaml(Path(SOURCE, "nucleation", "claims", "claims.yaml"))
PAIRED = "two bodies, simulated"


# Every quantitative statement of the paper with our number and a verdict (docs/claims.md), and the
# article that tells of them. Both stand on the paper's runs and the converged ones; claims about
# runs that the configuration does not have can't be checked, and say so.
make_rule(
    "evaluate_claims",
    call="nucleation.claims.evaluation:of_paper",
    shows="tables/claims",
    suffix="json",
    inputs={
        "theory": only("theory"),
        "dispersion": only("dispersion"),
        "lengths": lambda wildcards: lengths_of(*CLAIMED),
        "longer": lambda wildcards: simulations_of(BLOCKS),
        "patches": lambda wildcards: patches(*in_role(JUDGED)),
    },
    loads=sorted({*plugins(settings.base), *EVOLUTIONS}),
    statements={k: v for k, v in STATED.items() if k != PAIRED},
    interface=asdict(settings.main_text_interface),
    settings=asdict(settings.extraction),
    longer_runs=[{**run, "role": LONGER} for run in as_dicts(BLOCKS)],
    patch_ids=[run.id for run in patched_runs(*in_role(JUDGED))],
    message="Claims of the paper, our numbers and the verdicts",
    **CONFIGURED("material", "friction", "loading"),
)

# What the paper's theory says of two bodies, by simulations: verdicts of their own, for which
# those of `claims`, and so `make paper`, do not wait.
make_rule(
    "evaluate_pairs",
    call="nucleation.claims.evaluation:of_pairs",
    shows="tables/claims_pairs",
    suffix="md",
    inputs={"pairs": only("gather_pairs"), "modes": only("pair_modes")},
    statements={PAIRED: STATED[PAIRED]},
    message="Claims on two bodies, by simulations",
)

# The same with the figures that come after it, on paper.
make_rule(
    "print_article",
    call="nucleation.claims.printing:write",
    shows="replication",
    suffix="pdf",
    local=True,
    inputs={
        "template": str(Path(BASE, "docs", "article.md.in")),
        "citation": str(Path(BASE, "CITATION.cff")),
        "claims": only("evaluate_claims"),
        "lengths": lambda wildcards: lengths_of(*CLAIMED),
        "figures": lambda wildcards: [steps(f"draw_{name}") for name in PRINTED],
    },
    names=lambda wildcards: PRINTED,
    message="Article on the replication as PDF and LaTeX",
)

make_rule(
    "write_article",
    call="nucleation.claims.evaluation:write_article",
    shows="article",
    suffix="md",
    local=True,
    inputs={
        "template": str(Path(BASE, "docs", "article.md.in")),
        "claims": only("evaluate_claims"),
        "lengths": lambda wildcards: lengths_of(*CLAIMED),
    },
    message="Article on the replication, its numbers from the results",
)
