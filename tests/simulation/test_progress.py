"""What a run shows of itself while it works."""

import dataclasses
import io
import re

import numpy as np
import pytest

from nucleation.run.run import PAPER_RUN
from nucleation.simulation import progress
from nucleation.simulation.progress import Progress
from nucleation.simulation.run import instants, simulate

COARSE = PAPER_RUN.replaced(
    height=0.005, block_length=0.9, n_x=60, n_y=6, grading=2.0, end_time=30.0,
    time_after_event=0.0, tolerance=5e-2, longest_step=0.1
)  # fmt: skip


class Terminal(io.StringIO):
    def isatty(self):
        return True


@pytest.mark.slow
def test_log_gets_lines_with_what_one_wants_to_know(monkeypatch):
    monkeypatch.setattr(progress, "PAUSE", 0.0)
    log = io.StringIO()
    record = simulate(COARSE, progress=Progress(COARSE, log))
    lines = log.getvalue().splitlines()
    assert len(lines) == record.sizes["step"]
    pattern = (
        r"step (\d+): t = ([\d.e-]+) s, dt = ([\d.e-]+) s, max v = ([\d.e-]+) m/s, "
        r"patch ([\d.e-]+) m, rejected (\d+), (\d+) % of the way"
    )
    found = [re.fullmatch(pattern, line) for line in lines]
    assert all(found)
    assert [int(m[1]) for m in found] == list(range(record.sizes["step"]))
    np.testing.assert_allclose([float(m[2]) for m in found], record["step_time"], rtol=1e-4)
    last = found[-1]
    assert int(last[7]) >= 60  # the event comes at two thirds of the theory's length or later
    done = [int(m[7]) for m in found]
    assert max(np.diff(done)) <= 10 and min(np.diff(done)) >= 0


def test_terminal_gets_a_line_that_goes_away(monkeypatch):
    monkeypatch.setattr(progress, "PAUSE_ON_TERMINAL", 0.0)
    terminal = Terminal()
    short = COARSE.replaced(end_time=0.5)
    line = Progress(short, terminal)
    simulate(short, progress=line)
    line.close()
    shown = terminal.getvalue()
    assert "\n" not in shown.rstrip("\n")
    assert " % of the way" in shown and "max v = " in shown and "patch " in shown
    assert shown.endswith("\r") and shown.split("\r")[-2].strip() == ""


def test_a_simulation_of_the_library_shows_itself_on_a_terminal(monkeypatch):
    """It showed nothing for minutes; a file gets nothing, and False silences it."""
    short = COARSE.replaced(end_time=0.02, n_x=16)
    for stream, words, shows in (
        (Terminal(), {}, True),
        (Terminal(), {"progress": False}, False),
        (io.StringIO(), {}, False),
        (io.StringIO(), {"progress": True}, True),
    ):
        monkeypatch.setattr("sys.stderr", stream)
        progress.simulate(short, **words)
        assert ("max v = " in stream.getvalue()) == shows


@pytest.mark.parametrize(
    ("changed", "part"), [({}, 50), ({"end_time": 20.0}, 75), ({"end_time": 10.0}, 99)]
)
def test_part_of_the_way_is_by_the_end_time_where_no_patch_is_long(changed, part):
    instant = next(instants(COARSE))
    state = dataclasses.replace(instant.state, past_times=np.array([15.0]))
    log = io.StringIO()
    Progress(COARSE.replaced(**changed), log)(dataclasses.replace(instant, state=state))
    assert f", {part} % of the way" in log.getvalue()
