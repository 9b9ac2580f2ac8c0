"""What is around a run changes no result: other runs, places, copies, modules, and its own end."""

import dataclasses
import os
import shutil
import signal
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

from nucleation.fault.files import read_yaml
from replication.pipeline.planning import Plan

TABLE = "results/quick/tables/table_s1.csv"


def test_a_dry_run_with_other_values_changes_no_build(workflow):
    """It plans the same files while the build waits between its first job and the second."""
    other = {**read_yaml(workflow.config), "friction": {"aging_coefficient": 0.085}}
    log = workflow.directory / "results/quick/logs/theory.log"
    build = workflow.start("results/quick/theory.nc", TABLE, "--cores", "1", until=log.exists)
    build.send_signal(signal.SIGSTOP)
    planned = workflow.configured(other)(TABLE, "--dry-run", "--nolock")
    build.send_signal(signal.SIGCONT)
    printed, _ = build.communicate(timeout=300)
    assert build.returncode == 0 and "table_s1" in planned.stdout, printed
    text = (workflow.directory / TABLE).read_text()
    assert "0.085" not in text
    assert "5/18" in (workflow.directory / TABLE).with_suffix(".md").read_text()
    assert workflow.planned("table_s1") == {}
    assert workflow.configured(other).planned("table_s1") == {"table_s1": 1}


def test_no_module_of_the_working_directory_runs(workflow):
    for name in ("random", "nucleation", "replication", "pint", "netCDF4"):
        (workflow.directory / f"{name}.py").write_text("raise SystemExit('mine')\n")
    snakemake = Path(sys.executable).with_name("snakemake")
    done = subprocess.run(
        [snakemake, *workflow.arguments("table_s1")], cwd=workflow.directory, capture_output=True
    )
    assert done.returncode == 0, done.stderr


def test_a_moved_clone_and_a_copy_have_nothing_to_do(quick, workflow_type, checkout, tmp_path):
    """Neither the interpreter's path nor that of the clone is part of a rule."""
    clone = tmp_path / "clone"
    clone.mkdir()
    for part in ("Snakefile", "src", "workflow", "config", "docs", "profiles", "CITATION.cff"):
        (checkout.checkout / part).rename(clone / part)
    for part in ("results", ".snakemake"):
        shutil.copytree(quick.directory / part, clone / part, symlinks=True)
    settled = workflow_type(clone, clone, clone / "config" / "quick.yaml")
    settled.printed()
    for copy in (Path.rename, shutil.copytree):
        copy(clone, tmp_path / copy.__name__)
        clone = tmp_path / copy.__name__
        moved = workflow_type(clone, clone, clone / "config" / "quick.yaml")
        assert "Nothing to be done" in moved("--dry-run").stdout


def test_copies_that_follow_links_are_links_again_after_a_run(quick, tmp_path):
    shutil.copytree(quick.directory / "results", tmp_path / "results")
    copied = dataclasses.replace(quick, directory=tmp_path)
    copied.printed()
    results = tmp_path / "results" / "quick"
    assert not list(results.rglob("*~*"))
    assert all(path.is_symlink() for path in results.glob("simulations/*.nc"))
    assert "Nothing to be done" in copied("--dry-run").stdout


def test_a_simulation_is_not_planned_again_after_a_build(quick):
    (path, *_) = (quick.directory / "results/quick/simulations").iterdir()
    target = str(path.relative_to(quick.directory))
    assert "Nothing to be done" in quick(target, "--dry-run").stdout


def test_a_storage_is_refused_in_one_sentence():
    """Of Snakemake's plug-ins for storages, none of which is installed here."""
    output = SimpleNamespace(is_storage=True, apply_wildcards=lambda _: "results/a.nc")
    rule = SimpleNamespace(output=[output], input={}, params={})
    workflow = SimpleNamespace(is_main_process=True)
    plan = Plan(SimpleNamespace(a=rule), workflow, "results")
    with pytest.raises(SystemExit, match="a can't be planned: results are links, which no storage"):
        plan("a")({})


def test_ctrl_c_ends_with_one_line_and_check_too(workflow):
    logs = workflow.directory / "results/quick/logs/batches"

    def begun():
        return any("step 0:" in log.read_text() for log in logs.glob("*.log"))

    build = workflow.start("simulations", "--cores", "1", until=begun)
    os.killpg(build.pid, signal.SIGINT)
    printed, _ = build.communicate(timeout=300)
    assert build.returncode != 0 and printed.count("Stopped by Ctrl-C") == 1
    checked = workflow("check")
    assert checked.returncode != 0 and "findings: these results are not current" in checked.stdout
    for text in (printed, checked.stdout):
        assert not any(name in text for name in ("Exception", "CalledProcess", "WorkflowError"))
