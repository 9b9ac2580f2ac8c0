# The runs of each role, and the files that are made from them.
in_role = settings.studies_for

PAIR_STUDIES = in_role(*PAIR_ROLES)
CONVERGENCE_STUDIES = in_role(*REFINEMENTS)
CLAIMED = in_role(PAPERS, JUDGED)
"""Studies that claims are about."""
FLOORS = in_role("paper", "convergence_quiet")
"""Studies of quiet runs; the length at their drop shows the noise of the mesh."""
PATCH_TABLES = {
    "patch_stability": in_role("paper", "converged"),
    "patch_convergence": in_role("converged", "patch_convergence"),
}
"""Tables of patches, and the studies in each."""
TABLED = [
    name
    for name, study in settings.studies.items()
    if study.runs_per_job > 1 and not ROLES[study.role].one_by_one
]
"""Studies whose jobs also extract the lengths of their simulations."""
EXTRACTED = [name for name in settings.studies if name not in TABLED]
"""The other studies; a rule extracts their lengths."""


def one_of(names):
    """A regular expression that matches only these names; without names it matches nothing."""
    return "|".join(names) or "(?!)"


def needed(files, requirement):
    """An input function that returns files, or raises an error that names the requirement."""

    def given(wildcards):
        found = files()
        if not found:
            raise WorkflowError(f"the configuration has no {requirement}, which this target needs")
        return found

    return given


def or_refused(function, *arguments):
    """Call a function of the configuration; turn its error into one of the workflow."""
    try:
        return function(*arguments)
    except ParameterError as error:
        raise WorkflowError(str(error)) from None


OF_MESHES = []
"""Warnings about meshes and steps of the planned runs, and these runs."""


@functools.cache
def runs_of(study):
    """The runs of a study; warnings about them, and what a study of one's own is, appear once."""
    runs = or_refused(settings.runs_of, study)
    if PLANS and runs and runs[0].role == OWN:
        for setting in faults_of(runs):
            logger.info(f"Study {study}: {setting}")
    for text, coarse in warned(runs) if PLANS else []:
        if coarse:
            OF_MESHES.append((text, coarse))
        else:
            logger.warning(f"Warning: {text}")
    if OF_MESHES:
        place = Path(list_of_meshes())
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_text("".join(f"{text}\n" for text, _ in OF_MESHES), "utf-8")
    return runs


def list_of_meshes():
    """The file with the warnings about meshes and steps."""
    return f"{recipe.results}/logs/meshes.txt"


@functools.cache
def report_meshes():
    """Print one line about coarse meshes, once."""
    if OF_MESHES:
        coarse = [run for _, runs in OF_MESHES for run in runs]
        LOGGER.warning(f"Warning: {summary_of_meshes(coarse, list_of_meshes())}")


atexit.register(report_meshes)  # of a dry run, or where there is nothing to be done


REFUSED = []
"""Studies that were left out because they can't be run."""


@functools.cache
def is_usable(study):
    """Whether a study can be run. With --keep-going it is left out, and the workflow fails at the end."""
    problems = settings.problems_of(study)
    if problems and not (recipe.runs and workflow.execution_settings.keep_going):
        runs_of(study)  # raises the error
    for problem in problems:
        LOGGER.warning(f"The study {study} is left out: {problem}")
    if problems:
        REFUSED.append(study)
    return not problems


def run_of(name):
    """The run of a simulation."""
    return or_refused(settings.run, name)


@functools.cache
def runs_of_batch(batch):
    """The runs of one job; a run without a batch has its own job."""
    study = settings.studies.get(study_of(batch))
    if study is not None and study.runs_per_job == 1:
        return [run_of(batch)]
    return or_refused(settings.batch, batch)


def study_of(name):
    """The study of a run or a batch, by its name."""
    return name.partition("-")[0]


def runs_in(*studies):
    """The runs of some studies."""
    return [run for study in studies for run in runs_of(study)]


def runs_for(*roles):
    """The runs of all studies with these roles."""
    return runs_in(*in_role(*roles))


def as_dicts(runs):
    return [run.to_dict() for run in runs]


def laws_of(runs):
    """Modules that some runs load by name."""
    return sorted({law for run in runs for law in plugins(run.run.law)})


def simulations(runs):
    """The files of some simulations."""
    return [f"{RESULTS}/simulations/{run.id}.nc" for run in runs]


def batches(runs):
    """The files that the jobs of some runs write."""
    suffixes = {run.batch or run.id: "nc" if run.study in TABLED else "json" for run in runs}
    return [f"{RESULTS}/batches/{batch}.{suffix}" for batch, suffix in suffixes.items()]


def lengths_of(*studies):
    """The tables of lengths of some studies; a study that is not in the configuration is left out."""
    return [f"{RESULTS}/lengths/{study}.nc" for study in studies if study in settings.studies]


def table_of(role):
    """The table of lengths of the only study with a role; an empty list without such a study."""
    return (lengths_of(*in_role(role)) or [[]])[0]


def patched_runs(*studies):
    """The runs whose patches are followed: the first realisation of each fault."""
    return first_realisations(runs_in(*studies))


def patches(*studies):
    """The files with the stability of the patches of some studies."""
    return [f"{RESULTS}/patches/{run.id}.nc" for run in patched_runs(*studies)]


def patch_batches(*studies):
    """The files of the jobs that follow the patches of some studies."""
    return [f"{RESULTS}/patches/{study}.json" for study in studies]


def patch_tables():
    """The tables with lengths at which patches become unstable."""
    names = []
    if in_role(JUDGED):
        names.append("patch_stability")
    if PAIR_STUDIES:
        names.append("pairs")
    return [f"{RESULTS}/{name}.nc" for name in names]


def one_of_each_fault(runs):
    """The first run of each fault, in the order of their last runs."""
    found = {fault(run.run): run for run in reversed(runs)}
    return list(found.values())[::-1]


def inset_run():
    """The run in the inset of Figure 3: of H = 0.1 m, or the nearest."""
    return or_refused(settings.shown, 0.1)


def space_time_run():
    """The run in Figure S2: of H = 0.005 m, or the nearest."""
    return or_refused(settings.shown, 0.005)


def element(run):
    """All parameters of a run, but with the length of an element (m) for that of the block."""
    size = run.run.block.length / run.run.block.n_x
    return identity(run.run, "block_length", "n_x"), round(size, 9)


@functools.cache
def longer():
    """Pairs of runs that differ only in the length of the block: the longer one, the judged one."""
    found = []
    judged = [(element(run), run) for run in runs_for(JUDGED)]
    for block in runs_for(LONGER):
        for other, base in judged:
            if other == element(block):
                found += [block, base]
    return found
