"""Made-up results of a study are taken for its own by everything around the runs."""

import sys

import pytest
import yaml

from nucleation.configuration.load import configure, load
from nucleation.datasets import netcdf
from nucleation.pipeline.benchmark import scale
from nucleation.pipeline.benchmark.__main__ import main


@pytest.mark.parametrize("runs", [50, 150])
def test_the_study_has_so_many_runs(runs):
    assert len(configure(scale.configuration(runs)).runs) == runs


def test_numbers_of_runs_that_it_can_not_have_are_refused(monkeypatch, capsys):
    monkeypatch.setattr(sys, "argv", ["bench", "config/config.yaml", "scale", "--runs", "70"])
    with pytest.raises(SystemExit):
        main()
    assert "multiples of 50" in capsys.readouterr().err


def test_a_command_that_fails_is_said_with_its_output(tmp_path):
    with pytest.raises(RuntimeError, match="no such thing"):
        scale.cost(["-c", "raise SystemExit('no such thing')"], tmp_path)


def test_costs_are_those_of_the_processes(tmp_path):
    work = "x = bytearray(200_000_000); sum(range(3_000_000))"
    child = f"import subprocess, sys; subprocess.run([sys.executable, '-c', {work!r}])"
    cost = scale.cost(["-c", child], tmp_path)
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
    scale.cost(scale.COMMANDS["lengths"], tmp_path)
    rows = (tmp_path / "results/lengths.csv").read_text().splitlines()
    assert len(rows) == 51 and not (tmp_path / "results/logs/simulate").exists()
    scale.cost(scale.COMMANDS["check"], tmp_path)  # fails if anything is not current
    scale.cost(scale.COMMANDS["bundle"], tmp_path)
    (tmp_path / "results").rename(tmp_path / "moved")
    scale.cost(scale.COMMANDS["restore"], tmp_path)
    assert len(list((tmp_path / "results/simulations").iterdir())) == 50
