"""Many simulations in one job: the same results, found again one by one, whatever happens."""

import contextlib
import json
import shutil

import pandas as pd
import psutil
import pytest

from nucleation.datasets import netcdf
from replication.configuration.load import configure

SHORT = {
    "n_x": 40,
    "n_y": 3,
    "longest_step": 0.5,
    "tolerance": 5.0e-2,
    "end_time": 1.0,
    "record": "lengths",
}
HEIGHTS = (0.02, 0.03, 0.04)


def configuration(per_job, heights=HEIGHTS, study_name="many"):
    study = {
        "role": READ_ONE_BY_ONE if study_name == READ_ONE_BY_ONE else "own",
        "length_over_critical": 4.0,
        "runs_per_job": per_job,
        "defaults": SHORT,
        "runs": [{"height": list(heights)}],
    }
    return {"results": "results", "studies": {study_name: study}}


def with_one_that_fails(study_name):
    """Three runs in a batch; a second step can't be as short as one asks: it fails and says so."""
    values = configuration(3, study_name=study_name)
    study = values["studies"][study_name]
    study["runs"] = [
        {"height": [0.02, 0.04]},
        {"height": 0.03, "shortest_step": 9e-8, "longest_step": 3e-6},
    ]
    study["defaults"] = SHORT | {"tolerance": 1e-9, "end_time": 0.2}
    return values


READ_ONE_BY_ONE = "patch_convergence"
"""A role, and a study with it, of whose simulations other results are made one by one."""


def begun(workflow):
    """How many simulations were begun, by the logs."""
    logs = (workflow.directory / "results/logs").glob("*/*.log")
    return sum(path.read_text().count("step 0:") for path in logs)


def lengths_of(workflow):
    return pd.read_csv(workflow.directory / "results" / "lengths" / "many.csv")


def datasets(workflow):
    """The finished simulations in the store by their names with keys."""
    notes = (workflow.directory / "results/store").glob("[!.]*/entry.json")
    names = {json.loads(note.read_text())["name"]: note.with_name("result.nc") for note in notes}
    return {name: path for name, path in names.items() if "-aging-" in name}


def test_batches_are_mixed_whatever_the_grid():
    values = configuration(24)
    values["studies"]["many"]["runs"] = [
        {"height": {"start": 0.01, "stop": 0.1, "num": 12}, "seed": list(range(24))}
    ]
    batches = {}
    for run in configure(values).runs:
        batches.setdefault(run.batch, []).append(run.run.fault.height)
    assert {len(heights) for heights in batches.values()} == {24} and len(batches) == 12
    means = [sum(heights) / 24 for heights in batches.values()]
    assert max(means) - min(means) < 0.5 * 0.055  # of the mean height; in order it is 1.6 of it
    assert min(len(set(heights)) for heights in batches.values()) >= 6


@pytest.fixture(scope="module")
def batched(workflow_type, tmp_path_factory):
    """A study in batches of two, and the same with a job for each run."""
    directory = tmp_path_factory.mktemp("batched")
    (directory / "single").mkdir()
    workflow = workflow_type(directory).configured(configuration(2))
    single = workflow_type(directory / "single").configured(configuration(1))
    assert workflow.planned("lengths")["simulate_and_measure"] == 2
    for one in (workflow, single):
        one.printed("lengths", "--cores", "2")
    return workflow, single


def test_results_are_those_of_single_jobs(batched):
    workflow, single = batched
    pd.testing.assert_frame_equal(lengths_of(workflow), lengths_of(single))
    assert len(datasets(workflow)) == 3
    assert datasets(workflow).keys() == datasets(single).keys()
    assert_same_datasets(workflow, single)
    assert workflow.planned("lengths") == {}


def test_a_batch_reports_its_progress(batched):
    """One line for each run but the last; a job with one run has none."""
    counts = [
        sum(path.read_text().count(" of 2 runs done, about ") for path in logs)
        for one in batched
        for logs in [(one.directory / "results/logs").glob("*/*.log")]
    ]
    assert counts == [1, 0]


def assert_same_datasets(one, other):
    """The same runs by their keys, whatever the study, with the same values to the last bit."""
    found, expected = (
        {
            dataset.attrs["key"]: dataset.drop_attrs()
            for dataset in map(netcdf.read, datasets(made).values())
        }
        for made in (one, other)
    )
    assert found.keys() == expected.keys()
    for key, dataset in found.items():
        assert dataset.identical(expected[key])


def test_what_exists_is_not_made_again(batched):
    workflow, _ = batched
    before = {name: path.stat().st_mtime_ns for name, path in datasets(workflow).items()}
    heights = [0.02, 0.025, 0.03, 0.04]
    more = workflow.configured(configuration(3, heights), "more.yaml")
    more.printed("lengths", "--cores", "1")
    after = {name: path.stat().st_mtime_ns for name, path in datasets(workflow).items()}
    assert before.items() <= after.items() and len(after) == 4 and begun(workflow) == 1
    assert list(lengths_of(more)["height"]) == heights
    more.printed("check", "--cores", "1", "--quiet", "all")


def test_a_run_of_two_studies_is_made_once(workflow):
    """By the batch or by its own job, whichever comes first; the other takes it."""
    values = configuration(3)
    values["studies"]["alone"] = values["studies"]["many"] | {"runs_per_job": 1}
    values["studies"]["alone"]["runs"] = [{"height": HEIGHTS[0]}]
    both = workflow.configured(values)
    assert both.planned("lengths").items() >= {"simulate": 1, "simulate_and_measure": 1}.items()
    both.printed("lengths", "--cores", "1")
    assert begun(both) == len(datasets(both)) == 3
    assert both("results/figures/study_alone.png").returncode == 0
    checked = both("check")
    assert checked.returncode == 0, "both names of the run are the configuration's"


@pytest.mark.parametrize("study_name", ["many", READ_ONE_BY_ONE])
def test_runs_that_fail_do_not_take_the_others_with_them(workflow, study_name):
    failing = workflow.configured(with_one_that_fails(study_name))
    for _ in range(2):
        done = failing("lengths", "--cores", "1")
        assert done.returncode != 0 and "1 of 3 runs failed, the others are kept" in done.stdout
        assert len(datasets(failing)) == 2
    (log,) = (failing.directory / "results/logs/batches").glob("*.log")
    assert log.read_text().count("step 0:") == 1, "the one that failed"


def test_a_killed_batch_keeps_what_is_finished(workflow, batched):
    """And is, once run again, as one that nothing happened to."""
    slow = workflow.configured(configuration(3))
    process = slow.start("lengths", "--cores", "1", until=lambda: datasets(slow))
    for child in psutil.Process(process.pid).children(recursive=True):
        with contextlib.suppress(psutil.Error):
            child.kill()
    process.communicate(timeout=120)
    kept = {name: path.stat().st_mtime_ns for name, path in datasets(slow).items()}
    assert process.returncode != 0 and 1 <= len(kept) < 3
    slow.printed("lengths", "--cores", "1")
    after = {name: path.stat().st_mtime_ns for name, path in datasets(slow).items()}
    assert kept.items() <= after.items() and len(after) == 3
    _, single = batched
    assert datasets(slow).keys() == datasets(single).keys()
    assert_same_datasets(slow, single)


def test_a_batch_asked_to_stop_leaves_a_checkpoint_of_each_of_its_runs(workflow):
    """On two cores; what is made from the checkpoints is what is made without them."""
    values = configuration(2, HEIGHTS[:2])
    values["studies"]["many"]["defaults"] = SHORT | {"tolerance": 1e-4, "end_time": 4.0}
    slow = workflow.configured(values)
    two = ("--cores", "2", "--set-threads", "simulate_and_measure=2")
    process = slow.start("lengths", *two, until=lambda: begun(slow) == 2)
    for child in psutil.Process(process.pid).children(recursive=True):
        if "replication.pipeline.job" in child.cmdline():
            child.terminate()
    printed, _ = process.communicate(timeout=120)
    left = list((slow.directory / "results/unfinished").glob("*.checkpoint.npz"))
    assert process.returncode != 0 and len(left) == 2 and not datasets(slow), printed
    slow.printed("lengths", *two)
    (log,) = (slow.directory / "results/logs/batches").glob("*.log")
    assert log.read_text().count("the run resumes from results/unfinished") == 2

    whole = slow.configured(values | {"results": "whole"}, "whole.yaml")
    assert whole("lengths", "--cores", "1").returncode == 0
    for name, path in datasets(slow).items():
        (other,) = (slow.directory / "whole" / "store").glob(f"{path.parent.name}/result.nc")
        ours, theirs = (netcdf.read(file).drop_attrs() for file in (path, other))
        assert ours.identical(theirs), name


def test_what_is_read_one_by_one_is_what_a_batch_makes(workflow, batched):
    """Without a table of its own; of what is there already, nothing is made again."""
    quiet = workflow.configured(configuration(2, study_name=READ_ONE_BY_ONE))
    planned = quiet.planned("lengths")
    assert planned["simulate"] == 2
    quiet.printed("lengths", "--cores", "2")
    made, (_, single) = datasets(quiet), batched
    assert_same_datasets(quiet, single)
    assert len(made) == begun(quiet) == 3 and quiet.planned("lengths") == {}

    batches = (quiet.directory / "results/batches").glob("*.json")
    pair = max((path.read_text() for path in batches), key=len)  # the longer list, of two runs
    lost, *others = sorted(made.values(), key=lambda path: path.parent.name not in pair)
    kept = {path: path.read_bytes() for path in others}
    shutil.rmtree(lost.parent)
    shutil.rmtree(quiet.directory / "results/logs")
    assert quiet.planned("lengths")["simulate"] == 1
    quiet.printed("lengths", "--cores", "1")
    assert lost.is_file() and {path: path.read_bytes() for path in others} == kept
    assert begun(quiet) == 1
    other = workflow.configured(configuration(3, study_name=READ_ONE_BY_ONE), "other.yaml")
    done = other("lengths")
    assert done.returncode == 0 and "(simulate)" not in done.stdout, done.stdout
    assert begun(quiet) == 1
