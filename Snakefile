# The workflow of the replication: configuration, rules, and the targets that users ask for.
#
#   snakemake --workflow-profile workflow/profiles/default figure_3
#
# Data flow: theory and simulate -> extract -> draw. Results lie below the configuration's
# `results`, relative to the working directory. docs and workflow/rules/*.smk have the details.
import os
import sys
from dataclasses import asdict
from pathlib import Path

import snakemake.workflow
from snakemake.exceptions import WorkflowError
from snakemake.logging import logger
from snakemake.utils import min_version
from snakemake_executor_plugin_slurm import common_settings as slurm_settings

min_version("9.0")

# Members of a group run side by side only if the Snakemake within the Slurm job is told of the
# group, which the plugin omits (its issue 469): they would run one after the other.
slurm_settings.pass_group_args = True

# The one place that says where the package is, for this file and for the scripts of all jobs.
SOURCE = str(Path(workflow.basedir, "src"))
sys.path.insert(0, SOURCE)
os.environ["PYTHONPATH"] = os.pathsep.join(filter(None, [SOURCE, os.environ.get("PYTHONPATH")]))

from nucleation.configuration.advice import advise
from nucleation.pipeline.cache import CheckedCache
from nucleation.pipeline.repairs import (
    caption_where_made,
    show_why_groups_fail,
    suggest_targets,
)
from nucleation.pipeline.targets import default_target
from nucleation.configuration.load import configure
from nucleation.configuration.contradictions import directory_problem
from nucleation.datasets.provenance import digest
from nucleation.model.quantities import ParameterError
from nucleation.figures.catalogue import FIGURES
from nucleation.configuration.strict_yaml import read_yaml
from nucleation.configuration.settings import estimated_megabytes
from nucleation.configuration.studies import varied

# The profiles share simulations between checkouts and users (--cache simulate), where this variable
# says, if it does. Snakemake looks the class up under this name.
snakemake.workflow.LocalOutputFileCache = CheckedCache
if "SNAKEMAKE_OUTPUT_CACHE" not in os.environ:
    workflow.workflow_settings.cache = None

show_why_groups_fail()  # such as a partition that Slurm doesn't know
suggest_targets(lambda: workflow.rules)

# A configuration given with --configfile stands alone; config.yaml is the default.
if not workflow.overwrite_configfiles:
    configfile: str(Path(workflow.basedir, "config", "config.yaml"))


try:
    for path in workflow.configfiles:
        read_yaml(path)  # finds keys that stand twice, of which Snakemake keeps the last
    settings = configure(config)
    unusable = directory_problem(settings.results, write=not workflow.dryrun)
    if unusable:
        raise ParameterError(unusable)
except ParameterError as error:
    raise WorkflowError(str(error)) from None

if workflow.resource_settings.cores is not None and workflow.resource_settings.cores < 1:
    raise WorkflowError("--cores must be 1 or more: with less, Snakemake waits forever")

if workflow.is_main_process:  # and not again in each job
    for warning in advise(settings.runs):
        logger.warning(f"Warning: {warning}")

RESULTS = settings.results
RUNS = {run.id: run for run in settings.runs}
SHARED = [name for name, study in settings.studies.items() if study.table == "lengths"]
THEORY = f"{RESULTS}/theory.nc"
LENGTHS = f"{RESULTS}/lengths.nc"
DEFAULT = default_target(settings)


def simulation(id):
    """The dataset of one simulation."""
    return f"{RESULTS}/simulations/{id}.nc"


def runs_in(*studies):
    """The runs of those of some studies that the configuration has."""
    return [run for run in settings.runs if run.study in studies]


def simulations(*studies):
    """The datasets of their simulations."""
    return [simulation(run.id) for run in runs_in(*studies)]


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
    return str(Path(workflow.basedir, "workflow", "report", f"{name}.rst"))


report: str(Path(workflow.basedir, "workflow", "report", "workflow.rst"))


localrules:
    paper, studies, simulations, lengths, figure_1, figure_2, figure_3, figure_s1, figure_s2, table_s1,
    figure_patch_stability,


include: "workflow/rules/theory.smk"
include: "workflow/rules/simulate.smk"
include: "workflow/rules/extract.smk"
include: "workflow/rules/figures.smk"
include: "workflow/rules/patches.smk"
include: "workflow/rules/verification.smk"
include: "workflow/rules/studies.smk"
include: "workflow/rules/crosscheck.smk"
include: "workflow/rules/claims.smk"
include: "workflow/rules/report.smk"
include: "workflow/rules/check.smk"


# These take seconds, and run where snakemake runs. Everything else is for a cluster's jobs.
BRIEF = ("draw_", "extract", "gather_", "write_")
workflow.localrules(*(rule.name for rule in workflow.rules if rule.name.startswith(BRIEF)))


# Targets. Each names every file that it leads to, by the targets below it and by helpers such as
# measured(): after one failed or vanished, what was made from it would otherwise still count as up
# to date. A test goes through all targets.
rule paper:
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
    default_target: DEFAULT == "studies"
    input:
        [figure(f"study_{study}") for study in settings.studies],
        measured(*settings.studies),
        rules.lengths.input if SHARED else [],
    message:
        f"Lengths and a figure of each study are in {RESULTS}"


caption_where_made(workflow.rules)
