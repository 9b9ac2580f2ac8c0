# The workflow of the replication: configuration, rules, and the targets that users ask for.
#
#   snakemake figure_3
#
# Data flow: theory and simulate -> extract -> draw. Results lie below the configuration's
# `results`, relative to the working directory.
#
# A rule (`make_rule`) names the function that makes its result; with its code, its other parameters
# and its inputs this gives the result's key. `steps("RULE", "NAME")` is the path of a result: a file of
# the store results/store, or the link .links/NAME.KEY.nc that a job makes (nucleation.pipeline.steps).
import functools
import gc
import os
import runpy
import shlex
import sys
import threading
from dataclasses import asdict
from math import ceil
from pathlib import Path

from snakemake.exceptions import WorkflowError
from snakemake.logging import logger
from snakemake.utils import min_version

min_version("9.12")

BASE = Path(workflow.current_basedir)  # of this file, also where it is a module of another

# The one place that says where the package is, for this file and for the scripts of all jobs.
SOURCE = str(Path(BASE, "src"))
sys.path.insert(0, SOURCE)
os.environ["PYTHONPATH"] = os.pathsep.join(filter(None, [SOURCE, os.environ.get("PYTHONPATH")]))

# Compiled code that is outdated must not be run, here and in the jobs.
bytecode = runpy.run_path(str(Path(SOURCE, "nucleation", "pipeline", "bytecode.py")))
bytecode["make_checked"](Path(SOURCE, "nucleation"))
os.environ["NUMBA_CACHE_DIR"] = str(bytecode["cache_of_numba"](Path(SOURCE, "nucleation")))

from nucleation.configuration.advice import advise
from nucleation.configuration.contradictions import directory_problem
from nucleation.configuration.load import configure
from nucleation.configuration.roles import (
    JUDGED, LONGER, PAIRS as PAIR_ROLES, PAPERS, REFINEMENTS, ROLES,
)  # fmt: skip
from nucleation.configuration.runs import first_realisations, varied
from nucleation.configuration.settings import estimated_megabytes
from nucleation.configuration.strict_yaml import read_yaml
from nucleation.configuration.studies import theory_curves
from nucleation.configuration.study_names import study_parameters
from nucleation.datasets import provenance
from nucleation.datasets.variables import DatasetError
from nucleation.figures import catalogue
from nucleation.figures.catalogue import FIGURES
from nucleation.model.friction.law import Friction
from nucleation.model.friction.registry import plugins
from nucleation.model.identity import fault, identity
from nucleation.model.quantities import ParameterError
from nucleation.pipeline.launch import options
from nucleation.pipeline.steps import Steps
from nucleation.pipeline.store import StoreError, others

gc.freeze()  # what is loaded stays: looking through it takes a third of a second in all

# Jobs have other arguments.
os.environ.setdefault("NUCLEATION_CONFIGFILES", shlex.join(options().configfile))


try:
    provenance.moment()
    settings = configure(config)
    unusable = directory_problem(settings.results)
    if unusable:
        raise ParameterError(unusable)
    if "NUCLEATION_WARNED" not in os.environ:  # a job on a node that lacks a disk goes on
        others()  # the stores that the environment names can be used
except (ParameterError, StoreError, DatasetError) as error:
    print(error, file=sys.stderr)  # whatever Snakemake is told to be quiet about
    raise WorkflowError("the workflow can't be used like this, see above") from None

FIRST = "NUCLEATION_WARNED" not in os.environ  # and not the same again in each job
if FIRST:
    os.environ["NUCLEATION_WARNED"] = "yes"
    for warning in advise(settings.runs):
        logger.warning(f"Warning: {warning}")

RESULTS = settings.results
RUNS = {run.id: run for run in settings.runs}
SHARED = [name for name, study in settings.studies.items() if study.table == "lengths"]
DEFAULT = "paper" if settings.studies_for("paper") else "studies"
EVOLUTIONS = sorted({name for e in ("aging", "slip") for name in plugins(Friction(evolution=e))})
"""Code of the paper's law with either evolution, for what computes with both."""


steps = Steps(rules, RESULTS, tidies=FIRST)
link = steps.link


def log(name):
    """Log of the rule whose result is shown under a name."""
    return f"{RESULTS}/logs/{name}.{{key}}.log"


def CONFIGURED(*groups):
    """Groups of the configuration as parameters of a rule."""
    return {name: asdict(getattr(settings.base, name, None) or getattr(settings, name))
            for name in groups}  # fmt: skip


wildcard_constraints:
    name=r"[^/]+",
    key="[0-9a-f]{16}",


def one_of(names):
    """The constraint of a wildcard to some names, of which there may be none."""
    return "|".join(names) or "(?!)"


def needed(files, what):
    """An input function that gives some files, or says what the configuration lacks for them."""

    def given(wildcards):
        found = files(wildcards)
        if not found:
            raise WorkflowError(f"the configuration has no {what}, which this target needs")
        return found

    return given


SHOWN_BY = {}
"""The rules by the names of their results."""


def make_rule(
    rule_name, call, shows, message, suffix="nc", inputs={}, constraint=r"[^/]+", priority=0,
    local=False, megabytes=None, script_name="step", **params,
):  # fmt: skip
    """Define a rule that makes a result by a function.

    Parameters
    ----------
    rule_name : its name.
    call : the function, ``MODULE:NAME``. It is given the parameters, and the inputs by their role.
    shows, suffix : name and suffix of the result.
    message : what its jobs do, in words.
    inputs : files, or functions that give them, by their role.
    constraint : pattern of the wildcard ``name``.
    priority, local : as Snakemake has them. Local jobs take seconds: on a cluster they run where
        Snakemake does.
    megabytes : memory of a job that simulates, of its wildcards and the attempt.
    script_name : what runs the function.
    params : all else that the result depends on.
    """
    SHOWN_BY[shows] = rule_name
    simulates = {"mem_mb": megabytes, "runtime": ceil(settings.limits.runtime)}

    rule:
        name:
            rule_name
        input:
            **inputs,
        output:
            link(shows, suffix),
        log:
            log(shows),
        wildcard_constraints:
            name=constraint,
        priority: priority
        localrule: local
        resources:
            **(simulates if megabytes else {}),
        params:
            **params,
            call=call,
        message:
            message
        script:
            str(Path(BASE, "workflow", "scripts", f"{script_name}.py"))


def no_more_timers():
    """End at once: a timer of Snakemake's would let it wait until it looks for work once more."""
    for thread in threading.enumerate():
        if isinstance(thread, threading.Timer):
            thread.cancel()


onsuccess:
    no_more_timers()


onerror:
    no_more_timers()


include: "workflow/rules/studies.smk"
include: "workflow/rules/theory.smk"
include: "workflow/rules/simulations.smk"
include: "workflow/rules/patches.smk"
include: "workflow/rules/tables.smk"
include: "workflow/rules/figures.smk"
include: "workflow/rules/crosscheck.smk"
include: "workflow/rules/claims.smk"
include: "workflow/rules/report.smk"
include: "workflow/rules/targets.smk"


# Here, since `include` keeps the default target that was there before.
for _target in TARGETS:

    rule:
        name:
            _target
        default_target: _target == DEFAULT
        input:
            lambda wildcards, target=_target: [*wanted(target)],
        localrule: True
        params:
            shown=lambda wildcards, target=_target: shown(target),
            batched=lambda wildcards, target=_target: batched_simulations(wanted(target)),
            results=RESULTS,
            says=TARGETS[_target][0],
            main=lambda wildcards, target=_target: len(dict.fromkeys(TARGETS[target][1]())),
        message:
            TARGETS[_target][0]
        script:
            "workflow/scripts/show.py"
