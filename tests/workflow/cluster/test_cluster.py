"""The workflow on a cluster: pairs of simulations, lost jobs and nodes, the same results."""

import contextlib
from pathlib import Path

import numpy as np
import pandas as pd
import psutil
import pytest
from commands_of_slurm import output_of, wait_for

from nucleation.configuration.load import configure
from nucleation.configuration.settings import estimated_megabytes
from nucleation.configuration.strict_yaml import read_yaml
from nucleation.datasets import netcdf
from nucleation.simulation.checkpoints import VARIABLE

ROOT = Path(__file__).parents[3]
OFTEN = ("--slurm-init-seconds-before-status-checks", "2")
FIRST = "step 0:"  # in the log of a simulation that runs
AGAIN = "the run goes on from"  # in the log of one that was stopped
COSTS = ["wall_seconds", "peak_megabytes"]  # columns of the table that tell how long a run took

# Four simulations of the quick configuration with so short steps that they can be hit midway.
QUICK = read_yaml(ROOT / "config/quick.yaml")
STUDY = {**QUICK["studies"]["paper"], "runs": QUICK["studies"]["paper"]["runs"][:2]}
STUDY["defaults"] = {**STUDY["defaults"], "longest_step": 0.03}
CONFIG = {**QUICK, "studies": {"paper": STUDY}}
RUNS = configure(CONFIG).runs


def log_files(workflow):
    """The logs of simulations by id, as far as they exist."""
    paths = (workflow.directory / "results/quick/logs/simulate").glob("*.log")
    return {path.stem.rpartition(".")[0]: path for path in paths}


def logs(workflow):
    """What stands in them."""
    return {id: path.read_text() for id, path in log_files(workflow).items()}


def hold(workflow):
    """Suspend each simulation that is at work, so that none ends before all are; all suspended."""
    wanted = {str(path) for path in log_files(workflow).values() if FIRST in path.read_text()}
    held = []
    for process in psutil.process_iter():
        with contextlib.suppress(psutil.Error):
            if f"{workflow.directory}/.snakemake/scripts" not in " ".join(process.cmdline()):
                continue
            if wanted & {file.path for file in process.open_files()}:
                process.suspend()
                held.append(process)
    return held


def let_go(held):
    """Let those that are alive go on: a signal that they were sent meanwhile reaches them now."""
    for process in held:
        with contextlib.suppress(psutil.Error):
            process.resume()


def assert_same_variables(made, local, ids):
    """Simulations of a cluster are those made here, to the last bit."""
    for id in ids:
        cluster, here = (netcdf.read(ran.dataset("simulations", id)) for ran in (made, local))
        assert set(cluster.variables) == set(here.variables)
        for name, variable in here.variables.items():
            assert cluster[name].attrs == variable.attrs
            np.testing.assert_array_equal(cluster[name].values, variable.values, strict=True)


@pytest.fixture(scope="module")
def local(workflow_type, tmp_path_factory):
    """The same without a cluster."""
    made = workflow_type(tmp_path_factory.mktemp("local")).configured(CONFIG)
    done = made("lengths")
    assert done.returncode == 0, done.stdout
    return made


@pytest.fixture(scope="module")
def disturbed(slurm, workflow_type, tmp_path_factory):
    """Figure 3 through Slurm, losing a job and a node midway; how many ran side by side."""
    made = workflow_type(tmp_path_factory.mktemp("slurm"), profile="slurm").configured(CONFIG)
    with pytest.MonkeyPatch.context() as environment:  # no checkpoint by the clock
        environment.setenv(VARIABLE, "3600")
        process = made.start("figure_3", *OFTEN)
    try:
        wait_for(lambda: len(hold(made)) == 4 or process.poll() is not None)
        assert process.poll() is None, process.stdout.read()
        held = hold(made)
        jobs = slurm.jobs(made.directory)
        on = {job["NodeList"]: job["JobId"] for job in jobs if job["JobState"] == "RUNNING"}
        output_of("scancel", on["n2"])
        slurm.take_down("n1")
        let_go(held)
        (lost,) = (job for job in slurm.jobs(made.directory) if job["JobId"] == on["n1"])
        assert lost["JobState"] != "RUNNING"
        started = slurm.start()  # the node comes back
        assert started.returncode == 0, started.stdout
        output, _ = process.communicate(timeout=600)
        assert process.returncode == 0, output
    finally:
        slurm.end(process, made.directory)
    return made, slurm.jobs(made.directory), on


def test_pairs_of_simulations_on_both_nodes(disturbed):
    """What sbatch was asked for: two cores, the memory of both, the time of one."""
    _, jobs, on = disturbed
    pairs = [job for job in jobs if "simulate" in job["Comment"]]
    assert set(on) == {"n1", "n2"}
    assert [job["NumCPUs"] for job in pairs] == ["2"] * len(pairs)
    assert {job["TimeLimit"] for job in pairs} == {"01:00:00"}
    smallest, largest = (
        2 * (300 + f(estimated_megabytes(run.parameters) for run in RUNS)) for f in (min, max)
    )
    for job in pairs:
        attempt = 2 if job["JobId"] not in first_submissions(pairs) else 1
        asked = float(job["MinMemoryNode"].removesuffix("M"))
        assert attempt * smallest <= asked <= attempt * (largest + 2)


def first_submissions(jobs):
    """The jobs of the first attempt."""
    return sorted((job["JobId"] for job in jobs), key=int)[: len(RUNS) // 2]


def test_lost_job_and_node_are_made_up_for(disturbed):
    made, jobs, on = disturbed
    states = {job["JobId"]: job["JobState"] for job in jobs}
    assert states.pop(on["n2"]) == "CANCELLED"
    assert set(states.values()) == {"COMPLETED"}
    (lost,) = (job for job in jobs if job["JobId"] == on["n1"])
    assert lost["Restarts"] == "1"
    assert len(states) == 1 + len(RUNS) // 2  # theory, and all pairs but the cancelled one again
    assert sum(AGAIN in log for log in logs(made).values()) == 2  # the cancelled, not the lost


@pytest.fixture(scope="module")
def stopped(slurm, workflow_type, tmp_path_factory):
    """A job that is stopped by its time limit; started here, so that it need not be waited for."""
    checkout = tmp_path_factory.mktemp("stopped")
    for path in (Path(__file__).parent / "small").iterdir():
        (checkout / path.name).write_text(path.read_text())
    (checkout / "workflow").symlink_to(ROOT / "workflow")
    made = workflow_type(checkout, checkout=checkout, profile="slurm")
    process = made.start(*OFTEN)
    yield made, process
    slurm.end(process, checkout)


def test_results_of_the_cluster_are_the_local_ones(disturbed, stopped, local):
    """The job to be stopped begins before the local simulations, for a minute beside them."""
    made, _, _ = disturbed
    assert_same_variables(made, local, [run.id for run in RUNS])
    tables = [pd.read_csv(w.directory / "results/quick/lengths.csv") for w in (made, local)]
    pd.testing.assert_frame_equal(
        *(table.drop(columns=COSTS) for table in tables), check_exact=True
    )
    assert (made.directory / "results/quick/figures/figure_3.pdf").exists()


def test_generic_profile(slurm, workflow_type, tmp_path, local, stopped):
    """Two simulations in a job that is cancelled, and the theory in another."""
    made = workflow_type(tmp_path, profile="generic").configured(CONFIG)
    ids = [run.id for run in RUNS[:2]]
    wanted = [local.dataset("simulations", id).relative_to(local.directory) for id in ids]
    process = made.start("theory", *map(str, wanted))
    try:
        wait_for(lambda: len(hold(made)) == 2 or process.poll() is not None)
        assert process.poll() is None, process.stdout.read()
        held = hold(made)
        (pair,) = (job["JobId"] for job in slurm.jobs(tmp_path) if job["NumCPUs"] == "2")
        output_of("scancel", pair)
        let_go(held)
        output, _ = process.communicate(timeout=600)
        assert process.returncode == 0, output
    finally:
        slurm.end(process, tmp_path)
    states = {job["JobId"]: job["JobState"] for job in slurm.jobs(tmp_path)}
    assert states.pop(pair) == "CANCELLED"
    assert list(states.values()).count("COMPLETED") == len(states) == 2
    assert all(AGAIN in log for log in logs(made).values())
    assert_same_variables(made, local, ids)


def test_time_limit_leaves_time_for_a_checkpoint(stopped):
    """SIGTERM reaches a simulation's process a minute before the end, and a retry follows."""
    made, process = stopped
    output, _ = process.communicate(timeout=600)
    assert process.returncode == 0, output
    assert (made.directory / "heard.txt").read_text() == "heard, and lived on\n"


def test_starting_a_running_slurm_changes_nothing(slurm):
    daemons = ("controller", "n1", "n2")
    pids = [slurm.pid(name) for name in daemons]
    assert slurm.start().returncode == 0
    assert [slurm.pid(name) for name in daemons] == pids


def test_slurm_of_others_is_refused(slurm, tmp_path):
    config = tmp_path / "slurm.conf"
    config.write_text("ClusterName=others\n")
    refused = slurm.start(str(config))
    assert refused.returncode == 1
    assert "is not this script's: this machine belongs to a cluster already" in refused.stdout
    assert config.read_text() == "ClusterName=others\n"


def test_refusal_by_slurm_is_shown(slurm, workflow_type, tmp_path):
    made = workflow_type(tmp_path, profile="slurm").configured(CONFIG)
    wrong = ("--default-resources", "slurm_partition=nowhere", "mem_mb=500", "runtime=5")
    done = made("simulations", "--retries", "0", *wrong)
    assert done.returncode != 0
    assert "invalid partition specified: nowhere" in done.stdout
    assert "--wrap" not in done.stdout, "the reason, without some kB of command"


def test_batches_that_make_their_datasets_share_a_job(slurm, workflow_type, tmp_path):
    """As those do of which a table is made: one on each of its cores."""
    short = {"n_x": 40, "n_y": 3, "longest_step": 0.5, "tolerance": 5.0e-2, "end_time": 1.0}
    study = {"role": "quiet", "length_over_critical": 4.0, "runs_per_job": 2, "defaults": short,
             "runs": [{"height": [0.02, 0.03, 0.04]}]}  # fmt: skip
    made = workflow_type(tmp_path, profile="slurm").configured({"studies": {"quiet": study}})
    process = made.start("lengths", *OFTEN)
    try:
        output, _ = process.communicate(timeout=600)
        assert process.returncode == 0, output
        assert [job["NumCPUs"] for job in slurm.jobs(made.directory)] == ["2"]
    finally:
        slurm.end(process, made.directory)
    assert len(list((tmp_path / "results/simulations").glob("quiet-*.nc"))) == 3
