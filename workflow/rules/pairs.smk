# Beyond the paper's simulations: two deformable bodies, as in its theory. All studies with
# such a role are in one table, results/pairs.csv.
PAIRS = f"{RESULTS}/pairs.nc"


def pairs():
    """The table, with the patches and simulations in it."""
    return [*with_csv(PAIRS), *patches(*PAIR_STUDIES), *simulations(*PAIR_STUDIES)]


rule gather_pairs:
    input:
        simulations=needed(simulations(*PAIR_STUDIES), f"study with role: {', '.join(PAIR_ROLES)}"),
        patches=patches(*PAIR_STUDIES),
    output:
        dataset=PAIRS,
        table=f"{RESULTS}/pairs.csv",
    log:
        f"{RESULTS}/logs/pairs.log",
    params:
        **made_by("gather_pairs.py"),
        runs=[run.to_dict() for run in runs_in(*PAIR_STUDIES)],
        extraction=asdict(settings.extraction),
    message:
        "Lengths of the patches between two deformable bodies"
    script:
        "../scripts/gather_pairs.py"


# Single modes between two sliding layers, for Eqs. (7) and (8) and the verification.
rule pair_modes:
    output:
        dataset=f"{RESULTS}/pair_modes.nc",
        table=f"{RESULTS}/pair_modes.csv",
    log:
        f"{RESULTS}/logs/pair_modes.log",
    threads: 1
    params:
        **made_by("pair_modes.py", plugins(settings.base)),
        material=asdict(settings.base.material),
        friction=asdict(settings.base.friction),
        loading=asdict(settings.base.loading),
    message:
        "Growth of single modes between two layers, time integration and theory"
    script:
        "../scripts/pair_modes.py"


# What the paper's theory says of two bodies, by simulations: verdicts of their own, for which
# those of `claims`, and so `make paper`, do not wait.
rule evaluate_pairs:
    input:
        table=PAIRS,
        modes=rules.pair_modes.output.dataset,
    output:
        csv=f"{RESULTS}/tables/claims_pairs.csv",
        markdown=f"{RESULTS}/tables/claims_pairs.md",
    log:
        f"{RESULTS}/logs/claims_pairs.log",
    params:
        **made_by("claims_pairs.py"),
    message:
        "Claims on two bodies, by simulations"
    script:
        "../scripts/claims_pairs.py"


rule pairs:
    """Two deformable bodies: lengths over the theory of the own far sides, and verdicts."""
    input:
        pairs(),
        rules.evaluate_pairs.output,
        rules.pair_modes.output,
    localrule: True
    message:
        "The table of pairs is in {input[0]} and {input[1]}"
