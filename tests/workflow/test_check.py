"""The targets `check` and `prune`: what is not current, and what nothing refers to."""

import dataclasses
import re
import shutil

import numpy as np
import pytest
import xarray as xr

from nucleation.fault.files import read_yaml
from replication.pipeline import check

RUN = "paper-slip-H0.02-phi1"


@pytest.fixture
def copied(quick, tmp_path):
    """A plain copy of the results, without links and without Snakemake's notes."""
    shutil.copytree(
        quick.directory / "results", tmp_path / "results", copy_function=shutil.copyfile
    )
    return dataclasses.replace(quick, directory=tmp_path)


@pytest.fixture
def linked(quick, tmp_path):
    """A copy of the results with their links."""
    shutil.copytree(quick.directory / "results", tmp_path / "results", symlinks=True)
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
    found = states(copied.configured(values))
    assert {"lengths/paper.nc", "lengths.csv", "figures/figure_3.png", "article.md"} <= found.keys()
    assert set(found.values()) == {"stale"}
    assert not any(path.startswith("simulations") for path in found)
    values["friction"] = {"aging_coefficient": 0.08}
    assert states(copied.configured(values))[f"simulations/{RUN}.nc"] == "stale"


def test_damage_leftovers_and_strangers_are_found(linked):
    results = linked.directory / "results" / "quick"
    store, unfinished = results / "store", results / "unfinished"
    run, other = (
        linked.dataset("simulations", f"paper-{law}-H0.02-phi1").parent for law in ("slip", "aging")
    )
    run.rename(store / "other")
    other.rename(run)
    (store / "other").rename(other)  # whole entries, under each other's key
    shutil.copy(run / "result.nc", results / "simulations" / "mine.nc")
    xr.Dataset({"x": np.arange(3.0)}).to_netcdf(results / "other.nc")
    (store / ".half.tmp").mkdir()
    unfinished.mkdir(exist_ok=True)  # a slow run has made it for its checkpoint
    for name in (".a.checkpoint.npz.123.tmp", "a.checkpoint.npz", "a.failed.nc"):
        (unfinished / name).write_bytes(b"PK")
    cut = {}
    for name in ("theory.nc", "figures/figure_2.png", "lengths.csv", "article.md"):
        file = (results / name).resolve()
        cut[name] = f"store/{file.parent.name}"
        file.chmod(0o644)
        file.write_bytes(file.read_bytes()[:100])
    (results / "tables" / "table_s1.csv").unlink()
    (results / "tables" / "table_s1.csv").write_text("my own\n")
    shutil.rmtree((results / "figures" / "figure_1.png").resolve().parent)
    assert states(linked) == {
        f"store/{run.name}": "foreign",
        f"store/{other.name}": "foreign",
        "simulations/mine.nc": "foreign",
        "other.nc": "foreign",
        "store/.half.tmp": "incomplete",
        "unfinished/.a.checkpoint.npz.123.tmp": "incomplete",
        "unfinished/a.checkpoint.npz": "incomplete",
        "unfinished/a.failed.nc": "incomplete",
        **dict.fromkeys(cut.values(), "damaged"),
        "figures/figure_1.png": "damaged",
        "figures/figure_1.pdf": "damaged",
        "tables/table_s1.csv": "stale",
    }
    made = {"theory", "figure_2", "lengths", "write_article", "figure_1"}
    of_these = {"figure_3", "figure_s1", "figure_s2", "claims", "extract"}
    assert linked.planned() == {"simulate": 2, **dict.fromkeys(made | of_these, 1)}
    assert states(linked)[f"store/{run.name}"] == "foreign", "a dry run moves no entry"
    linked.printed()
    assert (results / "tables" / "table_s1.csv~").read_text() == "my own\n"
    left = {path.split("/")[0] for path in states(linked) if not path.startswith("store/damaged-")}
    assert left == {"simulations", "other.nc", "store", "unfinished", "tables"}


def files(directory):
    """Contents of all files but of recipes, which planning writes, and of logs."""
    found = [path for path in directory.rglob("*") if path.is_file()]
    return {path: path.read_bytes() for path in found if not {"recipes", "logs"} & {*path.parts}}


def of_table_s1(workflow, coefficient, results, target="table_s1"):
    """A configuration that has made a target that needs no simulation."""
    place = results.replace("/", "-")
    made = workflow.configured(
        {
            "results": results,
            "friction": {"aging_coefficient": coefficient},
            "studies": {"mine": {"runs": [{"height": 0.1}]}},
        },
        f"{place}-{coefficient}.yaml",
    )
    made.printed(target)
    return made


def pruned(workflow, monkeypatch, remove):
    monkeypatch.setenv("PRUNE", "yes" if remove else "")
    printed = workflow.printed("prune")
    return re.findall(r"^(results\S*)  (\S+)$", printed, re.M)


def test_unused_results_alone_are_listed_and_removed_if_that_is_asked_for(workflow, monkeypatch):
    """Not those of other configurations: below these, in them, or beside them in the same store."""
    first = of_table_s1(workflow, 0.08, "results")
    entry = (first.directory / "results/tables/table_s1.md").resolve().parent
    second = of_table_s1(workflow, 0.09, "results")  # shows others under the same names
    of_table_s1(workflow, 0.1, "results/deep/er")
    of_table_s1(workflow, 0.085, "results", target="figure_1")
    (workflow.directory / "beside").mkdir()
    (workflow.directory / "beside/store").symlink_to(workflow.directory / "results/store")
    of_table_s1(workflow, 0.095, "beside")
    before = files(workflow.directory / "results")
    kept = {path: before[path] for path in before if entry not in path.resolve().parents}
    (line,) = pruned(second, monkeypatch, remove=False)
    assert "deep" not in second("check").stdout
    assert line[0].endswith(entry.name) and line[1] == "tables/table_s1"
    assert files(workflow.directory / "results") == before
    assert pruned(second, monkeypatch, remove=True) == [line]
    assert not entry.exists()
    assert files(workflow.directory / "results") == kept
    again = first("table_s1")
    assert again.returncode == 0 and entry.exists(), again.stdout
