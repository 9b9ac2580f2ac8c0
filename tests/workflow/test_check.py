"""The target `check`: what is not current is found from the files alone."""

import dataclasses
import json
import re
import shutil

import numpy as np
import pytest
import xarray as xr

from nucleation.configuration.strict_yaml import read_yaml
from nucleation.datasets import netcdf
from nucleation.pipeline import check, keys
from nucleation.pipeline.keys import Store

RUN = "paper-slip-H0.02-phi1"


@pytest.fixture
def copied(quick, tmp_path):
    """A plain copy of the results, without Snakemake's notes and with other times."""
    shutil.copytree(
        quick.directory / "results", tmp_path / "results", copy_function=shutil.copyfile
    )
    return dataclasses.replace(quick, directory=tmp_path)


def listed(workflow):
    """What check lists: the state of each file, and its reason."""
    done = workflow("check")
    lines = re.findall(r"^(\w+) +results/quick/(\S+): (.+)$", done.stdout, re.M)
    wrong = [state for state, _, _ in lines if state != check.UNUSED]
    assert (done.returncode == 0) == (wrong == []), done.stdout
    assert ("All is current" in done.stdout) == (wrong == [])
    return {path: (state, reason) for state, path, reason in lines}


def states(workflow):
    return {path: state for path, (state, _) in listed(workflow).items()}


def test_fresh_results_and_their_copies_are_current(quick, copied):
    for workflow in (quick, copied):
        assert listed(workflow) == {}
        assert workflow.planned() == {}, "nothing was run or touched"


def test_other_parameters_are_stale(copied):
    values = read_yaml(copied.config)
    values["extraction"] = {**values.get("extraction", {}), "edge_threshold": 0.2}
    changed = copied.configured(values)
    found = listed(changed)
    assert found["lengths/paper.nc"] == ("stale", "its parameters changed")
    assert found["lengths.csv"] == ("stale", "its sources changed")
    assert found["figures/figure_3.png"][0] == found["article.md"][0] == "stale"
    assert not any(path.startswith("simulations") for path in found)
    values["friction"] = {"aging_coefficient": 0.08}
    (name,) = (path for path in listed(copied.configured(values)) if f"{RUN}." in path)
    assert name.startswith("simulations/")


def test_damage_leftovers_and_strangers_are_found(copied):
    results = copied.directory / "results" / "quick"
    run = copied.dataset("simulations", RUN)
    other = copied.dataset("simulations", "paper-aging-H0.02-phi1")
    shutil.copy(run, other)  # a whole dataset, of another key
    shutil.copy(run, run.with_name("mine.0123456789abcdef.nc"))
    (results / "simulations" / ".half.nc.123.tmp").write_bytes(b"CDF")
    (results / "simulations" / "a.checkpoint.npz").write_bytes(b"PK")
    shutil.copy(run, results / "simulations" / "a.failed.nc")
    xr.Dataset({"x": np.arange(3.0)}).to_netcdf(results / "other.nc")
    for name in ("theory.nc", "figures/figure_2.png", "lengths.csv", "article.md"):
        content = (results / name).read_bytes()
        (results / name).write_bytes(content[: len(content) // 2])
    patch = copied.dataset("patches", "converged-aging-H0.1-phi1")
    patch.write_bytes(patch.read_bytes()[:1000])
    (results / keys.RECORDS / "tables" / "table_s1.csv.json").unlink()
    assert states(copied) == {
        f"simulations/{other.name}": "foreign",
        "simulations/mine.0123456789abcdef.nc": "foreign",
        "simulations/.half.nc.123.tmp": "incomplete",
        "simulations/a.checkpoint.npz": "incomplete",
        "simulations/a.failed.nc": "incomplete",
        "other.nc": "foreign",
        "theory.nc": "damaged",
        "figures/figure_2.png": "damaged",
        "lengths.csv": "damaged",
        "article.md": "damaged",
        f"patches/{patch.name}": "damaged",
        "tables/table_s1.csv": "foreign",
    }
    # what has a plain name is made again; a dataset of another content is refused when it is read
    planned = copied.planned()
    assert {"theory", "draw_figure_2", "gather_lengths", "write_table_s1"} <= set(planned)
    assert "simulate" not in planned
    done = copied("lengths", "--forcerun", "extract")
    assert done.returncode != 0
    assert f"{other.name} is another result than it should be" in done.stdout


def test_datasets_of_earlier_parameters_are_named_and_pruned(copied):
    values = read_yaml(copied.config)
    values["studies"] = {"paper": values["studies"]["paper"]}
    less = copied.configured(values)
    found = states(less)
    unused = {path for path, state in found.items() if state == check.UNUSED}
    assert {path.split("/")[1].split("-")[0] for path in unused} == {"converged"}
    done = less("prune")
    assert done.returncode == 0 and done.stdout.count("removed results/quick/") == len(unused)
    results = less.directory / "results" / "quick"
    assert not any((results / path).exists() for path in unused)


def test_results_of_another_configuration_are_left_to_it(quick):
    """results/quick lies below the results of config.yaml, of which there are none here."""
    assert (quick.directory / "results/quick/simulations").is_dir()
    assert check.files(quick.directory / "results") == []


def test_every_damage_of_a_record_is_a_finding(tmp_path):
    store, path = Store(tmp_path), tmp_path / "a.csv"
    path.write_text("1\n")
    made = keys.parts("code", {}, {})
    store.sign(path, made)
    assert store.problem(path, made) is None
    assert store.problem(path, keys.parts("other", {}, {})) == "its code changed"
    record = store.record_of(path)
    for damage in ("", "[]", "{", "null", '{"content": 1}', "\udcff"):
        record.write_text(damage, errors="surrogateescape")
        assert "nothing vouches for it" in store.problem(path, made)
    store.sign(path, made)
    path.write_text("2\n")
    assert store.problem(path, made) == "it is not what was written"


def test_sources_and_units_stand_in_datasets(quick):
    dataset = netcdf.read(quick.directory / "results/quick/lengths/paper.nc")
    assert all(keys.key_in(path) for path in json.loads(dataset.attrs["sources"]))
