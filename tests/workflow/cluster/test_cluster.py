"""The workflow on a cluster: a core for each simulation, lost jobs and nodes, the same results."""

import contextlib
from pathlib import Path

import numpy as np
import pandas as pd
import psutil
import pytest
from commands_of_slurm import output_of, wait_for

from nucleation.datasets import netcdf
from nucleation.fault.files import read_yaml
from nucleation.run.checks import estimated_megabytes
from nucleation.simulation.checkpoints import VARIABLE
from replication.configuration.load import configure

ROOT = Path(__file__).parents[3]
OFTEN = ("--slurm-init-seconds-before-status-checks", "1")
FIRST = "step 0:"  # in the log of a simulation that runs
AGAIN = "the run resumes from"  # in the log of one that was stopped
COSTS = ["wall_seconds", "peak_megabytes"]  # columns of the table that tell how long a run took

# Three simulations of the quick configuration with so short steps that they can be hit midway.
QUICK = read_yaml(ROOT / "config/quick.yaml")
STUDY = {**QUICK["studies"]["paper"], "runs": QUICK["studies"]["paper"]["runs"][:1]}
STUDY["defaults"] = {"n_x": 40, "n_y": 4, "longest_step": 0.05, "time_after_event": 0.0}
CONFIG = {**QUICK, "studies": {"paper": STUDY}}
RUNS = configure(CONFIG).runs


def log_files(workflow):
    """The logs of simulations by id, as far as they exist."""
    paths = (workflow.directory / "results/quick/logs/batches").glob("*.log")
    return {path.stem: path for path in paths}


def logs(workflow):
    """What stands in them."""
    return {id: path.read_text() for id, path in log_files(workflow).items()}


def hold(workflow):
    """Suspend each simulation that is at work, so that none ends before all are; all suspended."""
    wanted = {str(path) for path in log_files(workflow).values() if FIRST in path.read_text()}
    held = []
    for process in psutil.process_iter():
        with contextlib.suppress(psutil.Error):
            if "replication.pipeline.job" not in process.cmdline():
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
    made.printed("lengths")
    return made


@pytest.fixture(scope="module")
def disturbed(slurm, workflow_type, tmp_path_factory):
    """Figure S2 and lengths through Slurm, losing a job and a node midway; jobs of each node."""
    made = workflow_type(tmp_path_factory.mktemp("slurm"), profile="slurm").configured(CONFIG)
    with pytest.MonkeyPatch.context() as environment:  # no checkpoint by the clock
        environment.setenv(VARIABLE, "3600")
        process = made.start("figure_s2", "lengths", *OFTEN)
    try:
        wait_for(lambda: len(hold(made)) == len(RUNS) or process.poll() is not None)
        assert process.poll() is None, process.stdout.read()
        held = hold(made)
        jobs = slurm.jobs(made.directory)
        on = {"n1": [], "n2": []}
        for job in jobs:
            if job["JobState"] == "RUNNING":
                on[job["NodeList"]].append(job["JobId"])
        output_of("scancel", on["n2"][0])
        slurm.take_down("n1")
        let_go(held)
        lost = [job for job in slurm.jobs(made.directory) if job["JobId"] in on["n1"]]
        assert "RUNNING" not in {job["JobState"] for job in lost}
        started = slurm.start()  # the node comes back
        assert started.returncode == 0, started.stdout
        output, _ = process.communicate(timeout=600)
        assert process.returncode == 0, output
    finally:
        slurm.end(process, made.directory)
    return made, slurm.jobs(made.directory), on


def test_a_core_for_each_simulation(disturbed):
    """What sbatch was asked for: a core, a run's memory, and twice that in the next attempt."""
    _, jobs, on = disturbed
    simulations = [job for job in jobs if "simulate" in job["Comment"]]
    assert {node: len(ids) for node, ids in on.items()} == {"n1": 2, "n2": 1}
    assert len(simulations) == 1 + len(RUNS)  # the cancelled one again
    assert {job["NumCPUs"] for job in simulations} == {"1"}
    assert {job["TimeLimit"] for job in simulations} == {"01:00:00"}
    smallest, largest = (450 + f(estimated_megabytes(run.run) for run in RUNS) for f in (min, max))
    again = max(simulations, key=lambda job: int(job["JobId"]))
    for job in simulations:
        attempt = 2 if job is again else 1
        asked = float(job["MinMemoryNode"].removesuffix("M"))
        assert attempt * smallest <= asked <= attempt * (largest + 1)


def test_lost_job_and_node_are_made_up_for(disturbed):
    """Nothing but simulations and what takes a while was submitted; figures and tables were not."""
    made, jobs, on = disturbed
    states = {job["JobId"]: job["JobState"] for job in jobs}
    assert states.pop(on["n2"][0]) == "CANCELLED"
    assert set(states.values()) == {"COMPLETED"}
    assert {job["Restarts"] for job in jobs if job["JobId"] in on["n1"]} == {"1"}
    assert len(states) == 1 + len(RUNS)  # the lengths as well
    assert sum(AGAIN in log for log in logs(made).values()) == 1  # the cancelled, not the lost


@pytest.fixture(scope="module")
def batch(slurm, workflow_type, tmp_path_factory):
    """Three simulations in one job, started here: what follows need not wait for it."""
    values = {**CONFIG, "studies": {"paper": STUDY | {"runs_per_job": 3}}}
    made = workflow_type(tmp_path_factory.mktemp("batch"), profile="slurm").configured(values)
    process = made.start("simulations", *OFTEN)
    yield made, process
    slurm.end(process, made.directory)


@pytest.fixture(scope="module")
def stopped(slurm, workflow_type, tmp_path_factory):
    """A job that is stopped by its time limit, started here as well."""
    checkout = tmp_path_factory.mktemp("stopped")
    for path in (Path(__file__).parent / "small").iterdir():
        (checkout / path.name).write_text(path.read_text())
    (checkout / "profiles").symlink_to(ROOT / "profiles")
    made = workflow_type(checkout, checkout=checkout, profile="slurm")
    process = made.start(*OFTEN, "--retries", "12")  # one that has not begun hears nothing
    yield made, process
    slurm.end(process, checkout)


def test_results_of_the_cluster_are_the_local_ones(disturbed, stopped, batch, local):
    """The jobs of the next tests begin before the local simulations, beside them."""
    made, _, _ = disturbed
    assert_same_variables(made, local, [run.id for run in RUNS])
    tables = [pd.read_csv(w.directory / "results/quick/lengths.csv") for w in (made, local)]
    pd.testing.assert_frame_equal(
        *(table.drop(columns=COSTS, errors="ignore") for table in tables), check_exact=True
    )
    assert (made.directory / "results/quick/figures/figure_s2.pdf").exists()


def test_time_limit_leaves_time_for_a_checkpoint(stopped):
    """SIGTERM reaches a simulation's process before the end, a minute away, and a retry follows."""
    made, process = stopped
    output, _ = process.communicate(timeout=600)
    assert process.returncode == 0, output
    seconds, _, said = (made.directory / "heard.txt").read_text().partition(" ")
    assert said == "s: heard, and lived on\n" and float(seconds) < 40.0


def test_a_batch_runs_on_two_cores(slurm, batch, local):
    """Two simulations at once, and the results of jobs of their own."""
    made, process = batch
    output, _ = process.communicate(timeout=600)
    assert process.returncode == 0, output
    (job,) = (job for job in slurm.jobs(made.directory) if "simulate" in job["Comment"])
    assert job["NumCPUs"] == "2" and job["JobState"] == "COMPLETED"
    (log,) = logs(made).values()
    until_one_has_ended, _, _ = log.partition(": completed")
    assert until_one_has_ended.count(FIRST) == 2
    assert_same_variables(made, local, [run.id for run in RUNS])


def test_slurm_of_others_is_refused(slurm, tmp_path):
    config = tmp_path / "slurm.conf"
    config.write_text("ClusterName=others\n")
    refused = slurm.start(str(config))
    assert refused.returncode == 1
    assert "is not this script's: this machine belongs to a cluster already" in refused.stdout
    assert config.read_text() == "ClusterName=others\n"
