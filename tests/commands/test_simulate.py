"""``nucleation simulate``: small runs, from options, files and a configuration."""

import json
import os
import re
import shlex
import subprocess

import numpy as np
import pytest

from nucleation.api import PAPER
from nucleation.commands.simulate import command
from nucleation.datasets import netcdf
from nucleation.extraction.extraction import extract
from nucleation.fault.parameters import parameters as run_parameters
from nucleation.model.quantities import ParameterError
from nucleation.run.advice import RunWarning
from nucleation.run.run import PAPER_RUN, Run
from nucleation.simulation.checkpoints import simulation_code
from nucleation.simulation.run import simulate

SMALL = [
    "--height",
    "5mm",
    "--block-length",
    "90cm",
    "--n-x",
    "16",
    "--n-y",
    "2",
    "--end-time",
    "20ms",
    "--second-body",
    "rigid",
]
PARAMETERS = PAPER_RUN.replaced(height=0.005, block_length=0.9, n_x=16, n_y=2, end_time=0.02)


def parameters_of(path):
    return Run.from_json(netcdf.read(path).attrs["parameters"])


def test_record_is_that_of_the_library(nucleation, tmp_path):
    output = tmp_path / "run.nc"
    ended = nucleation("simulate", output, *SMALL)
    assert ended.code == 0 and "no event: the force has not dropped" in ended.out
    assert "t = 0 s" in ended.err  # the progress, as a line
    dataset, expected = netcdf.read(output), simulate(PARAMETERS)
    for name in expected.variables:
        np.testing.assert_array_equal(dataset[name], expected[name])
    scale = parameters_of(output).perturbation.correlation_length
    assert parameters_of(output) == PARAMETERS.replaced(correlation_length=scale)
    assert dataset.attrs["code_digest"] == simulation_code(PARAMETERS)
    assert [path.name for path in output.parent.iterdir()] == ["run.nc"]  # no checkpoint is left


def test_the_command_in_the_dataset_makes_it_again(nucleation, tmp_path):
    output = tmp_path / "a run.nc"
    words = ["--evolution", "slip", "--initial-state", "20 min", "--density", "0"]
    assert nucleation("simulate", output, *SMALL, *words).code == 0
    first = netcdf.read(output)
    command = shlex.split(first.attrs["command"])
    assert command[:3] == ["nucleation", "simulate", str(output)]
    assert nucleation(*command[1:], "--force").code == 0
    again = netcdf.read(output)
    assert again.attrs["parameters"] == first.attrs["parameters"]
    assert json.loads(first.attrs["parameters"])["initial_state"] == 1200.0
    np.testing.assert_array_equal(again["slip_rate"], first["slip_rate"])


def test_a_failed_simulation_keeps_its_record(nucleation, tmp_path):
    output = tmp_path / "run.nc"
    ended = nucleation("simulate", output, *SMALL, "--shortest-step", "90ns")
    assert ended.code == 1 and not output.exists()
    assert "failed: the step size fell below" in ended.err and "run.failed.nc" in ended.err
    record = netcdf.read(tmp_path / "run.failed.nc")
    assert record.attrs["completed"] == 0 and "created" in record.attrs
    assert nucleation("simulate", output, *SMALL).code == 0
    assert [path.name for path in tmp_path.iterdir()] == ["run.nc"]


def planned(ended):
    """The parameters that a dry run prints, with their units."""
    rows = (re.split("  +", line) for line in ended.out.splitlines() if line.startswith("  "))
    return {name: value for _, name, value, _ in rows}


def test_dry_run_writes_nothing(nucleation, tmp_path):
    ended = nucleation("simulate", tmp_path / "run.nc", *SMALL, "--dry-run")
    assert ended.code == 0 and "theory: critical length 0.238 m" in ended.out
    assert "memory: about" in ended.out and not list(tmp_path.iterdir())
    assert planned(ended)["n_x"] == "16" and planned(ended)["height"] == "5 mm"
    assert ended.err.startswith("Warning: ")
    assert "mesh too coarse" in ended.err and "command" not in ended.err


def test_every_parameter_has_an_option(nucleation):
    help = nucleation("simulate", "--help").out
    text = " ".join(help.split())
    understood = {word for option in command.params for word in option.opts}
    for name, entry in run_parameters().items():
        assert f"--{name.replace('_', '-')} " in text
        assert entry.bounds.replace("one of ", "").split(", ")[0] in text
        assert f"--{name.replace('_', '-')}" in understood


STEPS = 10  # after which a run is stopped
STOPPED = f"""
import os, signal
from nucleation import __main__
from nucleation.simulation import progress
def stop(self, instant):
    assert os.environ["OPENBLAS_NUM_THREADS"] == "1"  # on one core, as in a job
    if instant.control.steps == {STEPS}:
        os.kill(os.getpid(), signal.SIGINT)
progress.Progress.__call__ = stop
__main__.start()
"""


@pytest.mark.system
def test_a_stopped_run_goes_on(nucleation, program, tmp_path):
    """A signal leaves a checkpoint; the same command goes on to the same record."""
    output = tmp_path / "run.nc"
    words = ["simulate", str(output), *SMALL]
    command = [program[0], "-c", STOPPED, *words]
    usual = {name: value for name, value in os.environ.items() if "NUM_THREADS" not in name}
    stopped = subprocess.run(command, capture_output=True, text=True, check=False, env=usual)
    assert stopped.returncode == 130, stopped.stderr
    assert "stopped by SIGINT" in stopped.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["run.checkpoint.npz"]
    ended = nucleation(*words)
    assert ended.code == 0 and "the run resumes from" in ended.err
    whole = simulate(PARAMETERS)
    assert whole.attrs["steps"] > 2 * STEPS
    np.testing.assert_array_equal(netcdf.read(output)["slip_rate"], whole["slip_rate"])
    assert [path.name for path in tmp_path.iterdir()] == ["run.nc"]


def test_a_specimen_shorter_than_the_theory_s_length_is_simulated(nucleation, tmp_path):
    """It was refused; whether it has an event is what one asks the simulation."""
    words = ["--height", "10cm", "--plane", "stress", "--second-body", "deformable", "--n-x", "100"]
    words += ["--block-length", "25cm", "--dry-run"]
    ended = nucleation("simulate", tmp_path / "run.nc", *words)
    assert ended.code == 0 and "critical length 0.3" in ended.out
    assert "may have an event all the same" in " ".join(ended.err.split())


@pytest.mark.slow
def test_a_run_without_an_end_time_has_its_event(nucleation, tmp_path):
    output = tmp_path / "run.nc"
    words = [
        "--height",
        "5mm",
        "--n-x",
        "60",
        "--n-y",
        "4",
        "--tolerance",
        "0.1",
        "--longest-step",
        "0.3",
        "--json",
        "--second-body",
        "rigid",
    ]
    ended = nucleation("simulate", output, *words)
    told = json.loads(ended.out)
    assert told["status"].startswith("completed: the event")
    assert told["event"] == pytest.approx(extract(netcdf.read(output)))
    shown = json.loads(nucleation("show", output, "--json").out)
    assert shown["event"] == told["event"]
    assert shown["attrs"]["parameters"] == told["parameters"]
    assert shown["data_vars"]["slip_rate"]["attrs"]["units"] == "m/s"


def test_a_strengthening_control_run_with_its_length(nucleation, tmp_path):
    output, words = tmp_path / "run.nc", [*SMALL, "--paper", "--zeta-over-a", "-0.5"]
    ended = nucleation("simulate", output, *words)
    assert ended.code == 0 and "no critical length" in ended.out and "no event" in ended.out
    assert "nothing will nucleate" in ended.err
    step = ["--heterogeneity", "zeta", "--change", "-2", "--width", "0.3", "--force", "--dry-run"]
    assert (
        "sliding outside the step or bump is stable"
        in nucleation("simulate", output, *words, *step).out
    )
    shown = nucleation("show", output)
    assert shown.code == 0 and "theory: no critical length: sliding is stable" in shown.out


def test_a_pipe_as_checkpoint_is_refused(nucleation, tmp_path):
    """The command waited for it for good, deaf to SIGTERM."""
    os.mkfifo(tmp_path / "run.checkpoint.npz")
    words = ("--paper", "--height", "5mm", "--n-x", "40", "--n-y", "2", "--end-time", "0.02s")
    ended = nucleation("simulate", tmp_path / "run.nc", *words)
    assert ended.code == 2 and "it is a pipe and no file" in ended.err
    assert not (tmp_path / "run.nc").exists()


def test_an_entry_of_a_plan_is_a_whole_sentence(nucleation, tmp_path):
    """It ended within a bracket: "height of the body (inf"."""
    ended = nucleation("simulate", tmp_path / "run.nc", *SMALL, "--dry-run")
    assert "height of the body (inf: half-space)" in ended.out


def test_a_plan_has_all_values_of_a_second_body_like_the_first(nucleation, tmp_path):
    words = [*SMALL[:-1], "deformable"]
    plan = planned(nucleation("simulate", tmp_path / "run.nc", *words, "--dry-run"))
    like = ("shear_modulus", "poisson_ratio", "density", "height", "n_y", "grading")
    assert {name: plan[f"second_{name}"] for name in like} == {name: plan[name] for name in like}


@pytest.mark.slow
def test_the_library_warns_of_a_run_as_the_command_does(nucleation, tmp_path):
    """It said nothing of meshes, blocks and times."""
    ended = nucleation("simulate", tmp_path / "run.nc", *SMALL, "--paper", "--dry-run")
    said = {line.removeprefix("Warning: ") for line in ended.err.splitlines()}
    short = {"block_length": 0.9, "n_x": 16, "n_y": 2, "end_time": 0.02}
    with pytest.warns(RunWarning) as caught:
        PAPER.simulate(**short, progress=False)
    assert {str(warning.message) for warning in caught} == said


def test_the_library_refuses_what_the_command_refuses():
    with pytest.raises(ParameterError, match=r"strength = 0.001 is not allowed with perturbation"):
        PAPER.simulate(block_length=0.9, n_x=16, n_y=2, end_time=0.02, strength=1e-3)
