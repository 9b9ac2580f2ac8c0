"""The target `check`: what is not current is found from the files alone."""

import dataclasses
import shutil
from collections import Counter
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from PIL import Image

from nucleation.configuration.load import configure, load
from nucleation.configuration.strict_yaml import read_yaml
from nucleation.datasets import netcdf
from nucleation.pipeline import check
from nucleation.pipeline.check import check_results, unverified

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
    dataset = netcdf.read(path)
    attributes = dict(dataset.attrs)
    changed = change(dataset, attributes)
    netcdf.write(changed if changed is not None else dataset, path, **attributes)


def test_fresh_results_are_current(quick):
    done = quick("check")
    assert done.returncode == 0, done.stdout
    assert "All is current" in done.stdout
    assert "Not checked, they do not say where they are from: article.md claims.json" in done.stdout
    assert check_results(load(quick.config), quick.directory) == []
    assert quick.planned() == {}, "nothing was run or touched"


def test_results_of_another_configuration_are_left_to_it(quick):
    """results/quick lies below the results of config.yaml, of which there are none here."""
    assert (quick.directory / "results/quick/simulations").is_dir()
    assert check_results(load(QUICK.with_name("config.yaml")), quick.directory) == []


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
        check, "digest_now", lambda c: "other" if "nucleation.simulation.run" in c else now(c)
    )
    findings = check_results(settings, directory)
    assert {found.path.parent.name for found in findings} == {"simulations"}
    assert all("code of nucleation.simulation.run has changed" in f.reason for f in findings)
    monkeypatch.undo()
    path = directory / settings.results / RUN
    rewritten(path, lambda _, a: a.update(code_digest="elsewhere.simulation @ numpy @ 123"))
    found = [f for f in check_results(settings, directory) if f.path == path]
    assert [f.state for f in found] == ["foreign"]


@pytest.mark.parametrize("attribute", ["parameters", "sources", "code_digest"])
def test_dataset_that_hides_its_origin_is_foreign(copied, attribute):
    directory, settings = copied
    path = directory / settings.results / "lengths.nc"
    dataset = netcdf.read(path)
    del dataset.attrs[attribute]
    netcdf.write(dataset, path)
    (found,) = check_results(settings, directory)
    assert (found.path, found.state) == (path, "foreign")
    assert found.reason.endswith(f"no attribute {attribute}")


def test_each_dataset_is_opened_once(copied, monkeypatch):
    directory, settings = copied
    damaged = directory / settings.results / RUN
    damaged.write_bytes(b"CDF")
    opened = Counter()
    for name in ("read", "attributes"):
        function = getattr(netcdf, name)
        monkeypatch.setattr(
            netcdf, name, lambda path, f=function: (opened.update([path]), f(path))[1]
        )
    assert states(check_results(settings, directory)) == {
        (damaged.name, "damaged"), ("paper.nc", "stale")
    }  # fmt: skip
    assert len(opened) > 10 and set(opened.values()) == {1}


@pytest.mark.parametrize(
    "change",
    [
        lambda text: text[: len(text) // 2],
        lambda text: text.replace("1", "2"),
        lambda text: text.replace("height", "depth", 1),
        lambda text: text + text.splitlines()[-1] + "\n",
        lambda text: "",
        lambda text: "\N{PLUS-MINUS SIGN}" + text,
    ],
)
@pytest.mark.parametrize("name", ["lengths", "dispersion", "lengths/paper"])
def test_table_that_differs_from_its_dataset_is_damaged(copied, name, change):
    directory, settings = copied
    path = directory / settings.results / f"{name}.csv"
    path.write_text(change(path.read_text()), encoding="latin-1")
    (found,) = check_results(settings, directory)
    assert (found.path, found.state) == (path, "damaged")
    assert found.reason == f"it does not hold what {path.stem}.nc does"


def test_what_can_not_be_checked_is_named(copied):
    directory, settings = copied
    results = directory / settings.results
    Image.new("L", (2, 2)).save(results / "figures" / "mine.png")
    (results / "figures" / "figure_3.png").write_bytes(b"")
    shutil.copy(results / "lengths.csv", results / "mine.csv")
    (results / "theory.checkpoint.npz").write_bytes(b"PK")
    names = [str(path.relative_to(results)) for path in unverified(settings, directory)]
    pdfs = [f"figures/figure_{name}.pdf" for name in ("1", "2", "3", "s1", "s2")]
    tables = [f"tables/{name}" for name in ("claims.csv", "claims.md", "table_s1.csv",
                                            "table_s1.md")]  # fmt: skip
    assert names == ["article.md", "claims.json", "mine.csv", *pdfs, "figures/mine.png", *tables]


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
