"""Every target names all files that it leads to.

Snakemake takes a file newer than its inputs for up to date even if an input is gone: it makes the
input again only if that itself is among the files of the target.
"""

import dataclasses
import re
import shutil
from pathlib import Path

import pytest
import yaml

ROOT = Path(__file__).parents[2]
JOB = re.compile(r"^(?:local)?rule (\w+):\n((?: {4}.+\n)+)", re.M)


@pytest.fixture
def plain(workflow, tmp_path, freefem_program):
    """The workflow without its messages: in their place a dry run lists the files of each job."""
    checkout = tmp_path / "checkout"
    shutil.copytree(ROOT / "workflow", checkout / "workflow")
    shutil.copy2(ROOT / "Snakefile", checkout)
    for name in ("src", "config", "docs"):
        (checkout / name).symlink_to(ROOT / name)
    for path in (checkout / "Snakefile", *checkout.glob("workflow/rules/*.smk")):
        path.write_text(re.sub(r"\n +message:\n.+", "", path.read_text()))
    return dataclasses.replace(workflow, checkout=checkout)


def jobs_of(listing):
    """Rule, inputs and outputs of all jobs that a dry run lists."""
    for rule, text in JOB.findall(listing):
        files = dict(re.findall(r"^ {4}(input|output): (.+)$", text, re.M))
        yield rule, *(set(files.get(kind, "").split(", ")) - {""} for kind in ("input", "output"))


def test_every_target_names_all_files_that_it_leads_to(plain):
    names = re.findall(r"^(\w+)(?: \(|$)", plain("--list-target-rules").stdout, re.M)
    jobs = list(jobs_of(plain(*names, "--dry-run").stdout))
    inputs = {file: given for _, given, made in jobs for file in made}
    targets = {rule: given for rule, given, made in jobs if not made}
    assert len(targets) > 25 and {"paper", "report", "crosscheck"} <= targets.keys()
    assert len(inputs) > 100
    for target, named in targets.items():
        led_to, waiting = set(), list(named)
        while waiting:
            file = waiting.pop()
            if file in inputs and file not in led_to:
                led_to.add(file)
                waiting += inputs[file]
        beside = {file for _, _, made in jobs if made & led_to for file in made}
        assert led_to | beside <= named, target


def test_configuration_of_ones_own_needs_no_target(workflow):
    """By default it makes its lengths and figures; the paper's are not among them."""
    defaults = {"n_x": 20, "n_y": 4, "end_time": 0.2}
    studies = {
        "mine": {"defaults": defaults, "runs": [{"height": [0.01, 0.02]}]},
        "alone": {"defaults": defaults, "table": "own", "runs": [{"height": 0.01}]},
    }
    planned = workflow.configured({"studies": studies}).planned()
    assert planned["simulate"] == 2, "a run that two studies have in common is made once"
    assert planned["draw_figure_study"] == 2
    assert planned["studies"] == 1 and planned["gather_lengths"] == 1
    assert not {"paper", "draw_figure_3", "evaluate_claims"} & planned.keys()


def test_wrong_target_is_told_the_nearest(workflow):
    done = workflow("figure_33", "--dry-run")
    assert done.returncode != 0
    assert "no target figure_33: did you mean figure_3" in done.stdout
    assert "Traceback" not in done.stdout


MODULE = """
configfile: "mine.yaml"

module nucleation:
    snakefile: "{snakefile}"
    config: config["fault"]

use rule * from nucleation as fault_*

rule all:
    default_target: True
    input: rules.fault_lengths.input
"""


def test_the_workflow_is_usable_as_a_module_of_another(workflow, tmp_path):
    (tmp_path / "Snakefile").write_text(MODULE.format(snakefile=ROOT / "Snakefile"))
    (tmp_path / "workflow").symlink_to(ROOT / "workflow")
    study = {"defaults": {"n_x": 40, "n_y": 4}, "runs": [{"height": [0.05, 0.1]}]}
    (tmp_path / "mine.yaml").write_text(yaml.safe_dump({"fault": {"studies": {"s": study}}}))
    other = dataclasses.replace(workflow, checkout=tmp_path, config=tmp_path / "mine.yaml")
    expected = {"fault_simulate": 2, "fault_extract": 1, "fault_gather_lengths": 1, "all": 1}
    assert other.planned() == expected


def test_every_target_has_a_text(workflow):
    listed = re.findall(r"^(\w+)  +\S", workflow("targets", "--quiet", "all").stdout, re.M)
    assert {"paper", "lengths", "figure_3", "report", "check"} <= set(listed)
    assert not {"simulate", "extract", "draw_figure_3"} & set(listed)
