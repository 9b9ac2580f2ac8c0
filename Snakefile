# The workflow of the replication: configuration, rules, and the targets that users ask for.
#
#   snakemake figure_3        snakemake results/lengths.csv        snakemake --list-rules
#
# Data flow: theory and simulate -> extract -> draw. Results are below the configuration's `results`,
# relative to the working directory; every file there that people open is the output of a rule.
#
# A rule names the function that makes its result (`call`), its parameters and its inputs. The recipe
# of the result collects these (replication.pipeline.planning). It is one more input of the rule, and it
# is newer than the output if and only if the output shows another result.
import atexit
import functools
import gc
import importlib.util
import inspect
import logging
import os
import runpy
import shlex
import signal
import sys
import threading
from dataclasses import asdict, fields
from math import ceil
from pathlib import Path

from snakemake.exceptions import WorkflowError
from snakemake.logging import logger
from snakemake.utils import min_version

min_version("9.27")

BASE = Path(workflow.current_basedir)  # of this file, also where it is a module of another

# The place of the package, for this file and for all jobs.
SOURCE = str(Path(BASE, "src"))
sys.path.insert(0, SOURCE)
PATHS = [SOURCE, *os.environ.get("PYTHONPATH", "").split(os.pathsep)]
os.environ["PYTHONPATH"] = os.pathsep.join(filter(None, PATHS))
os.environ["NUCLEATION_PYTHON"] = sys.executable  # a rule names no place: a clone may be moved

LIBRARIES = ("numpy", "scipy", "xarray", "netCDF4", "matplotlib", "yaml", "pint", "numba")
missing = [name for name in LIBRARIES if importlib.util.find_spec(name) is None]
if missing:
    raise WorkflowError(
        f"{', '.join(missing)} not installed beside this snakemake, in {sys.prefix}: run `make "
        "install` in the project's directory, and .venv/bin/snakemake there"
    )

# Outdated bytecode must not run, neither here nor in the jobs.
launch = runpy.run_path(str(Path(SOURCE, "replication", "pipeline", "launch.py")))
launch["make_checked"](Path(SOURCE))
os.environ["NUMBA_CACHE_DIR"] = str(launch["cache_of_numba"](Path(SOURCE, "nucleation")))

from replication.configuration.advice import faults_of, summary_of_meshes, warned
from replication.configuration.checks import directory_problem
from replication.configuration.load import configure
from replication.configuration.roles import JUDGED, LONGER, OWN, PAPERS, REFINEMENTS, ROLES
from replication.configuration.roles import PAIRS as PAIR_ROLES
from replication.configuration.runs import first_realisations, varied
from nucleation.run.checks import estimated_megabytes
from nucleation.fault.files import read_yaml
from nucleation.fault.parameters import parameters
from replication.configuration.studies import theory_curves
from nucleation.datasets import provenance
from nucleation.datasets.variables import DatasetError
from replication import figures
from nucleation.model.friction import Friction, plugins
from nucleation.run.derived import fault, identity
from nucleation.model.quantities import ParameterError, Quantity
from nucleation.simulation.checkpoints import SIMULATION
from replication.pipeline.check import CURRENT
from replication.pipeline import LOGGER
from replication.pipeline.planning import Plan
from replication.pipeline.store import others

gc.freeze()  # searching all loaded objects takes a third of a second in all
gc.set_threshold(50_000)  # of thousands of jobs nothing is garbage; this saves a twelfth of a plan

ON_CTRL_C = signal.getsignal(signal.SIGINT)


def stop_in_one_line(number, frame):
    """After Ctrl-C, have a line of ours in place of Snakemake's reports on jobs that it stops."""
    signal.signal(number, ON_CTRL_C)
    LOGGER.error("Stopped by Ctrl-C; the same command continues from here")
    logger.addFilter(lambda record: record.levelno < logging.ERROR)
    ON_CTRL_C(number, frame)


PLANS = workflow.is_main_process  # a job on a cluster reads this file as well

try:
    provenance.moment()
    settings = configure(config, lazy=True)  # a study is expanded once a target needs it
    unusable = directory_problem(settings.results)
    if unusable:
        raise ParameterError(unusable)
    if PLANS:  # a job continues even on a node that lacks a disk
        others()  # raises an error if a store elsewhere can't be used
except (ParameterError, DatasetError) as error:
    LOGGER.error(error)  # even if Snakemake is quiet
    raise WorkflowError("the workflow can't be used like this, see above") from None

if PLANS:
    signal.signal(signal.SIGINT, stop_in_one_line)
    os.environ["NUCLEATION_CONFIGFILES"] = shlex.join(launch["options"]().configfile)

RESULTS = settings.results
SHARED = [name for name, study in settings.studies.items() if study.table == "lengths"]
DEFAULT = "paper" if settings.studies_for("paper") else "studies"
EVOLUTIONS = sorted(
    {name for e in ("aging", "slip") for name in plugins(Friction(law="product", evolution=e))}
)
"""Code of the paper's law with either evolution, for rules that compute with both."""

EARLY = 3
"""Priority of rules that need no simulation: they run while the first job compiles for all others."""

PYTHON = 'exec "$NUCLEATION_PYTHON" -P'  # no module of the working directory runs
JOB = f"{PYTHON} -m replication.pipeline.job {{input.recipe:q}} {{rule}} {{threads}} {{log:q}}"
"""The command of every rule that makes a result."""


recipe = Plan(rules, workflow, RESULTS)


def asked_often(function):
    """A function with its signature at hand, for which Snakemake looks several times in each job."""
    function.__signature__ = inspect.signature(function)
    return function


def ours(path):
    """A file of this directory for an input, by a name that holds wherever the directory is moved."""
    return path if Path.cwd() == BASE.resolve() else str(BASE / path)


def no_more_timers():
    """Cancel Snakemake's timers: otherwise it would wait for the next one before it exits."""
    for thread in threading.enumerate():
        if isinstance(thread, threading.Timer):
            thread.cancel()


onstart:
    recipe.start()
    report_meshes()


onsuccess:
    no_more_timers()
    if recipe.checked and not Path(str(rules.check.log)).read_text().endswith(f"{CURRENT}\n"):
        sys.exit(1)
    if REFUSED:
        raise WorkflowError(f"studies that can't be run were left out, see above: {REFUSED}")


onerror:
    no_more_timers()


wildcard_constraints:
    study=r"\w+",
    name=r"[^/]+",
    batch=r"[^/]+",


include: "workflow/rules/studies.smk"
include: "workflow/rules/theory.smk"
include: "workflow/rules/simulations.smk"
include: "workflow/rules/patches.smk"
include: "workflow/rules/tables.smk"
include: "workflow/rules/figures.smk"
include: "workflow/rules/claims.smk"
include: "workflow/rules/targets.smk"


# These rules are here because `include` keeps an earlier default target.
rule paper:
    """Every figure, table and verdict of the paper"""
    default_target: DEFAULT == "paper"
    input:
        [f"{RESULTS}/figures/{name}.{kind}" for name in PAPERS_FIGURES for kind in ("png", "pdf")],
        rules.write_article.output,
        rules.claims.output,
        rules.table_s1.output,
        rules.lengths.output,


rule studies:
    """Tables and figures of all studies"""
    default_target: DEFAULT == "studies"
    input:
        lambda wildcards: of_studies(filter(is_usable, settings.studies)),
        rules.lengths.output if SHARED else [],
