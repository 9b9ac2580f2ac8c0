# Which runs have which role, and the files that are made of each.
in_role = settings.studies_for
SIMULATION = "nucleation.simulation.run"

PAIR_STUDIES = in_role(*PAIR_ROLES)
CONVERGENCE_STUDIES = in_role(*REFINEMENTS)
CLAIMED = in_role(PAPERS, JUDGED)
"""Studies that claims are about."""
FLOORS = in_role("paper", "convergence_quiet")
"""Studies of quiet runs, whose drops say how noisy their meshes are."""
PATCH_TABLES = {
    "patch_stability": in_role("paper", "converged"),
    "patch_convergence": in_role("converged", "patch_convergence"),
}
"""Tables of patches by the studies in them."""
TABLED = [
    name
    for name, study in settings.studies.items()
    if study.runs_per_job > 1 and not ROLES[study.role].one_by_one
]
"""Studies whose batches are measured by the jobs that make them."""
EXTRACTED = [name for name in settings.studies if name not in TABLED]
"""The others, of whose simulations lengths are read one by one."""


def one_of(names):
    """The constraint of a wildcard to some names, of which there may be none."""
    return "|".join(names) or "(?!)"


def needed(files, what):
    """An input function that gives some files, or says what the configuration lacks for them."""

    def given(wildcards):
        found = files()
        if not found:
            raise WorkflowError(f"the configuration has no {what}, which this target needs")
        return found

    return given


def or_refused(function, *arguments):
    """What a function of the configuration returns; its error as one of the workflow."""
    try:
        return function(*arguments)
    except ParameterError as error:
        raise WorkflowError(str(error)) from None


@functools.cache
def runs_of(study):
    """The runs of a study; what is unusual about them is warned of once."""
    runs = or_refused(settings.runs_of, study)
    if PLANS:
        for warning in advise(runs):
            logger.warning(f"Warning: {warning}")
    return runs


REFUSED = []
"""Studies that can't be run and were left out."""


@functools.cache
def is_usable(study):
    """Whether a study can be run. If not, a run with --keep-going leaves it out, and fails at its end."""
    problems = settings.problems_of(study)
    if problems and not (recipe.runs and workflow.execution_settings.keep_going):
        runs_of(study)  # which tells what is wrong
    for problem in problems:
        print(f"The study {study} is left out: {problem}", file=sys.stderr)
    REFUSED.extend([study] * bool(problems))
    return not problems


def run_of(name):
    """The run of a simulation."""
    return or_refused(settings.run, name)


@functools.cache
def runs_of_batch(batch):
    """The runs that one job makes; a run without a batch is one of its own."""
    study = settings.studies.get(study_of(batch))
    if study is not None and study.runs_per_job == 1:
        return [run_of(batch)]
    return or_refused(settings.batch, batch)


def study_of(name):
    """The study of a run or a batch, by its name."""
    return name.partition("-")[0]


def runs_in(*studies):
    """The runs of those of some studies that the configuration has."""
    return [run for study in studies for run in runs_of(study)]


def runs_for(*roles):
    """The runs of the studies with some roles."""
    return runs_in(*in_role(*roles))


def as_dicts(runs):
    return [run.to_dict() for run in runs]


def laws_of(runs):
    """Code that some runs load by name."""
    return sorted({law for run in runs for law in plugins(run.parameters)})


def simulations(runs):
    """The files of some simulations."""
    return [f"{RESULTS}/simulations/{run.id}.nc" for run in runs]


def batches(runs):
    """The files that are made by the jobs of some runs."""
    suffixes = {run.batch or run.id: "nc" if run.study in TABLED else "json" for run in runs}
    return [f"{RESULTS}/batches/{batch}.{suffix}" for batch, suffix in suffixes.items()]


def lengths_of(*studies):
    """The tables of lengths of those of some studies that the configuration has."""
    return [f"{RESULTS}/lengths/{study}.nc" for study in studies if study in settings.studies]


def table_of(role):
    """The table of lengths of the one study that has a role; nothing without it."""
    return (lengths_of(*in_role(role)) or [[]])[0]


def patched_runs(*studies):
    """The runs whose patches are followed: of each fault the first realisation."""
    return first_realisations(runs_in(*studies))


def patches(*studies):
    """The files with the stability of patches, of some studies."""
    return [f"{RESULTS}/patches/{run.id}.nc" for run in patched_runs(*studies)]


def patch_batches(*studies):
    """The files that are made by the jobs that follow the patches of some studies."""
    return [f"{RESULTS}/patches/{study}.json" for study in studies]


def patch_tables():
    """The tables with lengths at which patches turn unstable."""
    names = ["patch_stability"] * bool(in_role(JUDGED)) + ["pairs"] * bool(PAIR_STUDIES)
    return [f"{RESULTS}/{name}.nc" for name in names]


def one_of_each_fault(runs):
    """The first of some runs that each fault has."""
    return list({fault(run.parameters): run for run in reversed(runs)}.values())[::-1]


def inset_run():
    """The run that the inset of Figure 3 and the animation show."""
    return or_refused(settings.shown, settings.figures.inset_height)


def space_time_run():
    """The run that Figure S2 shows."""
    return or_refused(settings.shown, settings.figures.space_time_height)


def element(run):
    """All that a run is given but for the block's length, of which there is that of an element (m)."""
    size = run.parameters.geometry.length / run.parameters.mesh.n_x
    return identity(run.parameters, "geometry.length", "mesh.n_x"), round(size, 9)


@functools.cache
def longer():
    """The runs in longer blocks that differ from one of those judged in nothing else, and these."""
    blocks, judged = ([(element(run), run) for run in runs_for(role)] for role in (LONGER, JUDGED))
    return [run for like, block in blocks for other, base in judged if other == like
            for run in (block, base)]  # fmt: skip
