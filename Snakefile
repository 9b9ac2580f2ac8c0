# The workflow of the replication: configuration, rules, and the targets that users ask for.
#
#   snakemake --workflow-profile workflow/profiles/default figure_3
#
# Data flow: theory and simulate -> extract -> draw. Results lie below the configuration's
# `results`, relative to the working directory. docs and workflow/rules/*.smk have the details.
import functools
import gc
import os
import sys
from dataclasses import asdict
from pathlib import Path

from snakemake.exceptions import WorkflowError
from snakemake.logging import logger
from snakemake.utils import min_version
from snakemake_executor_plugin_slurm import common_settings as slurm_settings

min_version("9.0")

# Members of a group run side by side only if the Snakemake within the Slurm job is told of the
# group, which the plugin omits (its issue 469): they would run one after the other.
slurm_settings.pass_group_args = True

BASE = Path(workflow.current_basedir)  # of this file, also where it is a module of another

# The one place that says where the package is, for this file and for the scripts of all jobs.
SOURCE = str(Path(BASE, "src"))
sys.path.insert(0, SOURCE)
os.environ["PYTHONPATH"] = os.pathsep.join(filter(None, [SOURCE, os.environ.get("PYTHONPATH")]))

from nucleation.configuration.advice import advise
from nucleation.pipeline.repairs import (
    caption_where_made,
    show_why_groups_fail,
    suggest_targets,
)
from nucleation.pipeline.targets import default_target
from nucleation.configuration.load import configure
from nucleation.configuration.contradictions import directory_problem
from nucleation.pipeline import cache, keys, watch
from nucleation.pipeline.planning import Planner, decide_by_keys, names_asked_for
from nucleation.pipeline.time_left import predicted_cost
from nucleation.model.friction.registry import plugins
from nucleation.model.friction.law import Friction
from nucleation.model.quantities import ParameterError
from nucleation.datasets import provenance
from nucleation.datasets.variables import DatasetError
from nucleation.figures.catalogue import FIGURES
from nucleation.configuration.strict_yaml import read_yaml
from nucleation.configuration.settings import estimated_megabytes
from nucleation.configuration.roles import PAIRS as PAIR_ROLES, REFINEMENTS, ROLES, forgotten
from nucleation.configuration.runs import first_realisations, varied
from nucleation.configuration.studies import theory_curves

gc.freeze()  # what is loaded stays: looking through it takes a third of a second in all

show_why_groups_fail()  # such as a partition that Slurm doesn't know
suggest_targets(lambda: workflow.rules)

# A configuration given with --configfile stands alone; config.yaml is the default.
if not workflow.overwrite_configfiles:

    configfile: str(Path(BASE, "config", "config.yaml"))


try:
    for path in workflow.configfiles:
        read_yaml(path)  # finds keys that stand twice, of which Snakemake keeps the last
    settings = configure(config, names_asked_for(sys.argv))
    provenance.moment()
    unusable = directory_problem(settings.results, write=not workflow.dryrun)
    if unusable is None and cache.shared() is not None:
        unusable = cache.problem(cache.shared())
    if unusable:
        raise ParameterError(unusable)
except (ParameterError, DatasetError) as error:
    raise WorkflowError(str(error)) from None

if workflow.resource_settings.cores is not None and workflow.resource_settings.cores < 1:
    raise WorkflowError("--cores must be 1 or more: with less, Snakemake waits forever")

if workflow.is_main_process:  # and not again in each job
    for warning in [*forgotten(config, settings), *advise(settings.runs), cache.shared() and cache.warning(cache.shared())]:
        if warning:
            logger.warning(f"Warning: {warning}")

RESULTS = settings.results
STORE = keys.Store(RESULTS)
PLANNER = Planner(workflow, STORE)
decide_by_keys(PLANNER)
if workflow.is_main_process and not workflow.dryrun:
    cache.release(Path(RESULTS))
RUNS = {run.id: run for run in settings.runs}
SHARED = [name for name, study in settings.studies.items() if study.table == "lengths"]
THEORY = f"{RESULTS}/theory.nc"
LENGTHS = f"{RESULTS}/lengths.nc"
DEFAULT = default_target(settings)


EVOLUTIONS = sorted({name for e in ("aging", "slip") for name in plugins(Friction(evolution=e))})
"""Code of the paper's law with either evolution, which the verdicts compare."""


def script_path(script):
    return Path(BASE, "workflow", "scripts", script)


def made_by(script, modules=()):
    """Parameters by which a script's results are known (nucleation.pipeline.planning)."""
    return PLANNER.made_by(script_path(script), modules)


def keyed(kind, name, script, parameters, sources=(), modules=()):
    """The dataset of a kind that bears its key: of this script, parameters and sources.

    The parameters are those of the rule that makes it; `sources` gives paths by their role there.
    """
    sources = {role: [PLANNER.key(path) for path in paths] for role, paths in dict(sources).items()}
    code = PLANNER.code(script_path(script), modules)
    return STORE.dataset(kind, name, keys.key(code, parameters, sources))


def place_of(kind):
    """The pattern of the datasets of a kind that bear their keys."""
    return f"{RESULTS}/{kind}/{{name}}.{{key}}.nc"


wildcard_constraints:
    name=r"[^/]+",
    key="[0-9a-f]{16}",


@functools.cache
def simulation(id):
    """The dataset of one simulation."""
    parameters = RUNS[id].parameters
    given = {"parameters": parameters.to_dict()}
    return keyed("simulations", id, "simulate.py", given, modules=plugins(parameters))


def of_key(paths, what, names):
    """A function that gives the name to which a dataset's key belongs.

    A key that is not among the paths is one of an earlier configuration or code: nothing makes it.
    """

    @functools.cache
    def by_key():
        return {keys.key_in(paths(name)): name for name in names}

    def found(wildcards):
        own = wildcards.name  # what was found under its key may go by another name
        if own in names and keys.key_in(paths(own)) == wildcards.key:
            return own
        if wildcards.key not in by_key():
            raise WorkflowError(
                f"{what} {wildcards.name}.{wildcards.key} is not of the present configuration and "
                "code: start the workflow again"
            )
        return by_key()[wildcards.key]

    return found


def run_of_key(paths, what):
    """A function that gives the run to which a dataset's key belongs."""
    name = of_key(paths, what, RUNS)
    return lambda wildcards: RUNS[name(wildcards)]


simulated = run_of_key(simulation, "simulation")


def runs_in(*studies):
    """The runs of those of some studies that the configuration has."""
    return [run for run in settings.runs if run.study in studies]


PAIR_STUDIES = settings.studies_for(*PAIR_ROLES)


def simulations(*studies):
    """The datasets of their simulations."""
    return [simulation(run.id) for run in runs_in(*studies)]


def made(*studies):
    """What jobs make of their runs: simulations, or the tables of batches of them."""
    names = [run.batch for run in runs_in(*studies) if run.study in TABLED]
    single = [simulation(run.id) for run in runs_in(*studies) if run.study not in TABLED]
    return [*single, *map(batch, dict.fromkeys(names))]


def one_of(names):
    """The constraint of a wildcard to some names, of which there may be none."""
    return "|".join(names) or "(?!)"


def laws_of(runs):
    """Code that some runs load by name."""
    return sorted({law for run in runs for law in plugins(run.parameters)})


def code_of(script, run):
    """The code that makes a run's result."""
    return PLANNER.code(script_path(script), plugins(run.parameters))


def grouped_like(name):
    """The group of a rule on a cluster: that of another one, if the profile puts it in any."""
    return lambda wildcards: workflow.group_settings.overwrite_groups.get(name)


def needed(files, what):
    """An input function that gives some files, or says what the configuration lacks for them."""

    def given(wildcards):
        found = files(wildcards) if callable(files) else files
        if not found:
            raise WorkflowError(f"the configuration has no {what}, which this target needs")
        return found

    return given


def figure(name):
    """The files of a figure, shown in reports with its caption if they list it."""
    pdf, png = multiext(f"{RESULTS}/figures/{name}", ".pdf", ".png")
    return [pdf, captioned(png, name) if name in FIGURES else png]


def captioned(path, name):
    """A file for reports: Snakemake's own (--report) and the project's have the same captions."""
    entry = FIGURES[name]
    return report(
        path, caption=caption_file(name), category=entry.category, labels={"shows": entry.title}
    )


def caption_file(name):
    return str(Path(BASE, "workflow", "report", f"{name}.rst"))


report: str(Path(BASE, "workflow", "report", "workflow.rst"))


localrules:
    paper,
    studies,
    simulations,
    lengths,
    table_s1,


include: "workflow/rules/theory.smk"
include: "workflow/rules/simulate.smk"
include: "workflow/rules/batches.smk"
include: "workflow/rules/extract.smk"
include: "workflow/rules/patches.smk"
include: "workflow/rules/pairs.smk"
include: "workflow/rules/verification.smk"
include: "workflow/rules/studies.smk"
include: "workflow/rules/drop.smk"
include: "workflow/rules/map.smk"
include: "workflow/rules/figures.smk"
include: "workflow/rules/crosscheck.smk"
include: "workflow/rules/claims.smk"
include: "workflow/rules/report.smk"
include: "workflow/rules/check.smk"


onstart:
    watch.begin(
        workflow,
        lambda: {
            simulation(id): predicted_cost(run.parameters, run.theory_length)
            for id, run in RUNS.items()
        },
    )


onerror:
    watch.end()


onsuccess:
    watch.end()
    cache.release(Path(RESULTS))
    from nucleation.analysis.events import in_table

    for study in settings.studies:
        ids = [run.id for run in settings.runs_of(study)]
        for line in in_table(Path(study_lengths(study)).with_suffix(".csv"), ids):
            logger.warning(f"Study {study}: {line}")


# These take seconds, and run where snakemake runs. Everything else is for a cluster's jobs.
BRIEF = ("draw_", "extract", "gather_", "join_", "write_")
workflow.localrules(*(rule.name for rule in workflow.rules if rule.name.startswith(BRIEF)))


# Targets. Each names every file that it leads to, by the targets below it and by helpers such as
# measured(): after one failed or vanished, what was made from it would otherwise still count as up
# to date. A test goes through all targets.
rule paper:
    """Every figure, table and verdict of the paper."""
    default_target: DEFAULT == "paper"
    input:
        rules.figure_1.input,
        rules.figure_2.input,
        rules.figure_3.input,
        rules.figure_s1.input,
        rules.figure_s2.input,
        rules.table_s1.input,
        rules.lengths.input,
        rules.article.input,
    message:
        f"Every figure, table and verdict is in {RESULTS}"


# The default of a configuration that does not have the paper's runs.
rule studies:
    """Tables and figures of all studies that share lengths.csv."""
    default_target: DEFAULT == "studies"
    input:
        [figure(f"study_{study}") for study in settings.studies],
        measured(*settings.studies),
        rules.lengths.input if SHARED else [],
    message:
        f"Lengths and a figure of each study are in {RESULTS}"


caption_where_made(workflow.rules)
