"""Made-up results of a study are taken for its own by everything around the runs."""

import sys

import pytest
import yaml

from nucleation.configuration.load import configure, load
from nucleation.datasets import netcdf
from nucleation.model.parameters import Geometry, Mesh, Parameters
from nucleation.pipeline.benchmark import batched, overhead, processes, scale
from nucleation.pipeline.benchmark.__main__ import main


@pytest.mark.parametrize("runs", [50, 150])
def test_the_study_has_so_many_runs(runs):
    assert len(configure(scale.configuration(runs)).runs) == runs
    batches = batched.batches_of(configure(batched.configuration(runs)).runs)
    assert [len(own) for own in batches.values()] == [batched.PER_JOB] * (runs // batched.PER_JOB)


def test_small_studies_have_so_many_runs():
    for runs, per_job in overhead.STUDIES.values():
        found = configure(overhead.configuration(runs, per_job)).runs
        assert len(found) == runs
        assert len({run.batch for run in found}) == (runs // per_job if per_job > 1 else 1)


def test_levels_of_recording_take_less_and_less():
    parameters = Parameters(geometry=Geometry(0.02, 1.0), mesh=Mesh(60, 10))
    sizes = overhead.on_disk(parameters.replaced({"end_time": 0.5}))
    assert list(sizes) == ["everything", "interface", "lengths"]
    assert sizes["everything"] > sizes["interface"] > sizes["lengths"] > 0.0


def test_numbers_of_runs_that_it_can_not_have_are_refused(monkeypatch, capsys):
    monkeypatch.setattr(sys, "argv", ["bench", "config/config.yaml", "scale", "--runs", "70"])
    with pytest.raises(SystemExit):
        main()
    assert "multiples of 50" in capsys.readouterr().err


def test_a_command_that_fails_is_said_with_its_output(tmp_path):
    with pytest.raises(RuntimeError, match="no such thing"):
        processes.cost(["-c", "raise SystemExit('no such thing')"], tmp_path)


def test_costs_are_those_of_the_processes(tmp_path):
    work = "x = bytearray(200_000_000); sum(range(3_000_000))"
    child = f"import subprocess, sys; subprocess.run([sys.executable, '-c', {work!r}])"
    cost = processes.cost(["-c", child], tmp_path)
    assert cost.megabytes > 190.0 and 0.02 < cost.processor_seconds < 10.0


@pytest.mark.slow
@pytest.mark.system
def test_made_up_results_are_current_and_whole(tmp_path):
    path = tmp_path / "config.yaml"
    path.write_text(yaml.safe_dump(scale.configuration(50)))
    settings = load(path)
    assert scale.fill(settings, tmp_path) == sum(
        file.stat().st_size for file in (tmp_path / "results/simulations").iterdir()
    )
    for file in list((tmp_path / "results/simulations").iterdir())[:3]:
        assert netcdf.read(file).attrs["key"] in file.name
    processes.cost(scale.COMMANDS["lengths"], tmp_path)
    rows = (tmp_path / "results/lengths.csv").read_text().splitlines()
    assert len(rows) == 51 and not (tmp_path / "results/logs/simulate").exists()
    processes.cost(scale.COMMANDS["check"], tmp_path)  # fails if anything is not current
    processes.cost(scale.COMMANDS["bundle"], tmp_path)
    (tmp_path / "results").rename(tmp_path / "moved")
    processes.cost(scale.COMMANDS["restore"], tmp_path)
    assert len(list((tmp_path / "results/simulations").iterdir())) == 50


@pytest.mark.slow
@pytest.mark.system
def test_made_up_batches_are_those_of_the_map(tmp_path):
    """Nothing is run for the map's table, figure and page, and all of it is current."""
    path = tmp_path / "config.yaml"
    path.write_text(yaml.safe_dump(batched.configuration(50)))
    batched.fill(load(path), tmp_path)
    processes.cost(batched.COMMANDS["figure_map"], tmp_path)
    assert len((tmp_path / "results/map.csv").read_text().splitlines()) == 51
    assert not (tmp_path / "results/logs/batches").exists()
    processes.cost(batched.COMMANDS["check"], tmp_path)
