"""The target `check`: what is not current is found from the files alone."""

import dataclasses
import shutil
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from nucleation import check, datasets
from nucleation.check import check_results
from nucleation.configuration import configure, load
from nucleation.strict_yaml import read_yaml

QUICK = Path(__file__).parents[2] / "config" / "quick.yaml"
RUN = "simulations/paper-slip-H0.02-phi1.nc"


@pytest.fixture
def copied(quick, tmp_path):
    """A copy of the results without Snakemake's notes on them, and their configuration."""
    shutil.copytree(quick.directory / "results", tmp_path / "results", symlinks=True)
    return tmp_path, load(quick.config)


def states(findings):
    return {(found.path.name, found.state) for found in findings}


def rewritten(path, change):
    dataset = datasets.read(path)
    attributes = dict(dataset.attrs)
    changed = change(dataset, attributes)
    datasets.write(changed if changed is not None else dataset, path, **attributes)


def test_fresh_results_are_current(quick):
    done = quick("check")
    assert done.returncode == 0, done.stdout
    assert "All is current" in done.stdout
    assert check_results(load(quick.config), quick.directory) == []
    assert quick.planned() == {}, "nothing was run or touched"


def test_other_parameters_are_stale(copied):
    directory, settings = copied
    values = read_yaml(QUICK)
    values["friction"] = {**values.get("friction", {}), "rate_coefficient": 0.006}
    findings = check_results(configure(values), directory)
    named = {found.path.name: found.reason for found in findings}
    assert "friction.rate_coefficient = 0.005 (now 0.006)" in named["paper-slip-H0.02-phi1.nc"]
    assert {found.state for found in findings} == {"stale"}
    simulations = (directory / settings.results / "simulations").glob("*.nc")
    assert len([f for f in findings if f.path.parent.name == "simulations"]) == len([*simulations])


def test_other_code_is_stale_and_unknown_code_foreign(copied, monkeypatch):
    directory, settings = copied
    now = check.digest_now
    monkeypatch.setattr(
        check, "digest_now", lambda c: "other" if "nucleation.simulation" in c else now(c)
    )
    findings = check_results(settings, directory)
    assert {found.path.parent.name for found in findings} == {"simulations"}
    assert all("code of nucleation.simulation has changed" in f.reason for f in findings)
    monkeypatch.undo()
    path = directory / settings.results / RUN
    rewritten(path, lambda _, a: a.update(code_digest="elsewhere.simulation @ numpy @ 123"))
    found = [f for f in check_results(settings, directory) if f.path == path]
    assert [f.state for f in found] == ["foreign"]


def test_source_replaced_by_another_makes_stale(copied):
    directory, settings = copied
    path = directory / settings.results / RUN
    rewritten(path, lambda dataset, _: dataset.assign(slip=dataset["slip"] * 2))
    assert states(check_results(settings, directory)) == {("paper.nc", "stale")}
    path.unlink()
    (found,) = check_results(settings, directory)
    assert "which can't be read" in found.reason


def test_damage_leftovers_and_strangers_are_found(copied):
    directory, settings = copied
    results = directory / settings.results
    shutil.copy(results / RUN, results / "simulations" / "mine-aging-H3-phi1.nc")
    (results / "simulations" / ".half.nc.123.tmp").write_bytes(b"CDF")
    (results / "simulations" / "a.checkpoint.npz").write_bytes(b"PK")
    shutil.copy(results / RUN, results / "simulations" / "a.failed.nc")
    xr.Dataset({"x": np.arange(3.0)}).to_netcdf(results / "other.nc")
    for name in ("theory.nc", "figures/figure_2.png"):
        content = (results / name).read_bytes()
        (results / name).write_bytes(content[: len(content) // 2])
    found = states(check_results(settings, directory))
    assert found == {
        ("mine-aging-H3-phi1.nc", "foreign"),
        (".half.nc.123.tmp", "incomplete"),
        ("a.checkpoint.npz", "incomplete"),
        ("a.failed.nc", "incomplete"),
        ("other.nc", "damaged"),
        ("theory.nc", "damaged"),
        ("figure_2.png", "damaged"),
    }


def test_each_part_of_the_settings_matters(copied):
    directory, settings = copied
    edges = dataclasses.replace(settings.extraction, edge_threshold=0.2)
    changed = dataclasses.replace(settings, extraction=edges)
    names = {found.path.parent.name for found in check_results(changed, directory)}
    assert names == {"lengths"}
