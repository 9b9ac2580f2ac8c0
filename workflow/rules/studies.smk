# Which runs play which role, and the results that are made of each.
in_role = settings.studies_for
runs_for = settings.runs_for


def runs_in(*studies):
    """The runs of those of some studies that the configuration has."""
    return [run for run in settings.runs if run.study in studies]


def as_dicts(runs):
    return [run.to_dict() for run in runs]


def laws_of(runs):
    """Code that some runs load by name."""
    return sorted({law for run in runs for law in plugins(run.parameters)})


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
"""Studies in batches that are measured by the job that makes them."""

BATCHES = {}
for _run in settings.runs:
    if _run.batch:
        BATCHES.setdefault(_run.batch, []).append(_run)


def only(rule, name=""):
    """An input function that gives the result of a rule."""
    return lambda wildcards: steps(rule, name)


def together(rule, runs, job):
    """What one job has to do to make the results of a rule for several runs."""
    return steps.together(rule, [run.id for run in runs], job)


def of_runs(rule, runs):
    """The results of a rule for each of some runs."""
    return steps.several(rule, [run.id for run in runs])


def simulations_of(runs):
    return of_runs("simulate", runs)


def simulations(*studies):
    return simulations_of(runs_in(*studies))


def made_by_jobs(*studies):
    """What jobs make of the runs of studies: simulations, or the tables of batches of them."""
    runs = runs_in(*studies)
    batches = dict.fromkeys(run.batch for run in runs if run.study in TABLED)
    single = [run for run in runs if run.study not in TABLED]
    return [*simulations_of(single), *steps.several("batch", batches)]


def batched_simulations(made):
    """Names and keys of the simulations of the batches among some results."""
    names = [one.shown.removeprefix("batches/") for one in made.values()
             if one.shown.startswith("batches/")]  # fmt: skip
    simulated = [steps.made("simulate", run.id) for name in names for run in BATCHES[name]]
    return [(one.shown, one.key) for one in simulated]


def lengths_of(*studies):
    """The tables of lengths of those of some studies that the configuration has."""
    present = [study for study in studies if study in settings.studies]
    return [steps("join_batches" if s in TABLED else "extract", s) for s in present]


def table_of(role):
    """The table of lengths of the one study that has a role; nothing without it."""
    return (lengths_of(*in_role(role)) or [[]])[0]


def patched_runs(*studies):
    """The runs whose patches are followed: of each fault the first realisation."""
    return first_realisations(runs_in(*studies))


def patches(*studies):
    return of_runs("patch", patched_runs(*studies))


def patch_tables():
    """The tables with lengths at which patches turn unstable."""
    stability = [steps("gather_patches", "patch_stability")] if in_role(JUDGED) else []
    return stability + ([steps("gather_pairs")] if PAIR_STUDIES else [])


PATCHED_TOGETHER = [
    study
    for study in dict.fromkeys([*sum(PATCH_TABLES.values(), []), *PAIR_STUDIES])
    if len(patched_runs(study)) > 1
]


def one_of_each_fault(runs):
    """The first of some runs that each fault has."""
    return list({fault(run.parameters): run for run in reversed(runs)}.values())[::-1]


def shown_run(height):
    """The simulation that a figure shows, by height (m)."""
    try:
        return settings.shown(height).id
    except ParameterError as error:
        raise WorkflowError(f"a figure can't be drawn: {error}") from None


def inset_id(wildcards):
    return shown_run(settings.figures.inset_height)


def space_time_id(wildcards):
    return shown_run(settings.figures.space_time_height)


def element(run):
    """All that a run is given but for the block's length, of which there is that of an element (m)."""
    size = run.parameters.geometry.length / run.parameters.mesh.n_x
    return identity(run.parameters, "geometry.length", "mesh.n_x"), round(size, 9)


def longer():
    """The runs in longer blocks that differ from one of those judged in nothing else, and these."""
    blocks, judged = ([(element(run), run) for run in runs_for(role)] for role in (LONGER, JUDGED))
    return [run for like, block in blocks for other, base in judged if other == like
            for run in (block, base)]  # fmt: skip


BLOCKS = longer()
