# Beyond the paper's simulations: two deformable bodies, as in its theory. All studies whose base is
# deformable in every run are in one table, results/pairs.csv.
PAIRS = f"{RESULTS}/pairs.nc"


def is_pair(study):
    """Whether all runs of a study have two bodies."""
    runs = settings.runs_of(study)
    return bool(runs) and all(run.parameters.below is not None for run in runs)


PAIR_STUDIES = [study for study in settings.studies if is_pair(study)]


def pairs():
    """The table, with the patches and simulations in it."""
    return [*with_csv(PAIRS), *patches(*PAIR_STUDIES), *simulations(*PAIR_STUDIES)]


rule gather_pairs:
    input:
        simulations=needed(simulations(*PAIR_STUDIES), "study of two deformable bodies"),
        patches=patches(*PAIR_STUDIES),
    output:
        dataset=PAIRS,
        table=f"{RESULTS}/pairs.csv",
    params:
        runs=[run.to_dict() for run in runs_in(*PAIR_STUDIES)],
        extraction=asdict(settings.extraction),
        **made_by("gather_pairs.py"),
    log:
        f"{RESULTS}/logs/pairs.log",
    message:
        "Lengths of the patches between two deformable bodies"
    script:
        "../scripts/gather_pairs.py"


rule pairs:
    """Two deformable bodies: lengths over the theory of the own far sides."""
    input:
        pairs(),
    localrule: True
    message:
        "The table of pairs is in {input[0]} and {input[1]}"
