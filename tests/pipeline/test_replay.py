"""The time left is held against runs as they were."""

import datetime
import json

import pytest
import xarray as xr
from nucleation.pipeline.time_left import predicted_cost

from nucleation.datasets import netcdf
from nucleation.model.linearised import linearised
from nucleation.model.parameters import Parameters
from nucleation.pipeline.benchmark import replay
from nucleation.pipeline.benchmark.replay import Ran
from nucleation.theory.critical import run_length


def one_after_another(durations, begin=0.0):
    runs = []
    for i, duration in enumerate(durations):
        runs.append(Ran(f"{begin}-{i}", 1.0, begin, begin + duration, duration))
        begin += duration
    return runs


def test_equal_runs_are_told_exactly():
    assert replay.errors(one_after_another([2.0] * 40)) == pytest.approx([0.0] * 6, abs=1e-9)


def test_what_can_not_be_known_is_an_error():
    """The second half takes three times as long: after a tenth half of what is left is told."""
    told = replay.errors(one_after_another([1.0] * 50 + [3.0] * 50), parts=(0.1, 0.5))
    assert told[0] == pytest.approx(90.0 / (40.0 + 150.0) - 1.0)
    assert told[1] == pytest.approx(50.0 / 150.0 - 1.0)


def test_starts_of_the_workflow_are_told_apart():
    first, second = one_after_another([2.0] * 30), one_after_another([2.0] * 40, begin=1000.0)
    alone = one_after_another([2.0] * 3, begin=5000.0)
    found = replay.sessions([*alone, *second, *first])
    assert [len(session) for session in found] == [30, 40]


def test_by_steps_other_work_of_the_machine_is_left_out():
    """Two at a time, the first half twice as slow as the second for the same steps."""
    slow = [Ran(f"a{i}", 1.0, 4.0 * (i // 2), 4.0 * (i // 2) + 4.0, 7.0) for i in range(20)]
    quick = [Ran(f"b{i}", 1.0, 40.0 + i // 2 * 2.0, 42.0 + i // 2 * 2.0, 7.0) for i in range(20)]
    runs = [*slow, *quick]
    assert replay.errors(runs)[0] > 0.2
    even = replay.by_steps(runs)
    assert {round(run.end - run.begin, 9) for run in even} == {3.0}
    assert max(run.end for run in even) == pytest.approx(60.0)
    assert replay.errors(even) == pytest.approx([0.0] * 6, abs=1e-9)


def test_runs_are_read_from_their_datasets(tmp_path):
    (tmp_path / "simulations").mkdir()
    parameters = Parameters()
    for i in range(20):
        moment = datetime.datetime.fromtimestamp(1e9 + 3.0 * (i + 1), datetime.UTC)
        record = xr.Dataset(
            attrs={
                "parameters": json.dumps(parameters.to_dict()), "created": moment.isoformat(),
                "wall_seconds": 3.0, "steps": 100 + 10 * i,
            }
        )  # fmt: skip
        netcdf.write(record, tmp_path / f"simulations/run{i}.{i:016x}.nc")
    runs = replay.runs_of(tmp_path)
    length = run_length(parameters, linearised(parameters.friction, parameters.loading))
    assert len(runs) == 20
    assert {run.cost for run in runs} == {predicted_cost(parameters, length)}
    assert {run.end - run.begin for run in runs} == {3.0}
    assert max(run.work for run in runs) / min(run.work for run in runs) == pytest.approx(2.9)
    was, steps = (line.split() for line in replay.report(tmp_path).splitlines()[2:])
    assert was[:5] == ["20", "0.02", "as", "it", "was"]
    assert [abs(int(error)) for error in was[5::2]] == [0] * 6
    assert steps[2:4] == ["by", "steps"] and int(steps[4]) < -30
    assert "no 20 runs" in replay.report(tmp_path / "nothing")
