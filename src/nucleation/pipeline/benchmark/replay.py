"""How right the time left would have been: the runs of results that are there, once more in time.

When each run began and ended, its dataset tells; :class:`nucleation.pipeline.time_left.TimeLeft`
is told of it as it would have been while they ran, and its word is held against what came. What
else the machine did meanwhile can't be foreseen, so the runs are also put in time by steps alone.
"""

from __future__ import annotations

import datetime
import heapq
import json
from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

from ...datasets import netcdf
from ...model.linearised import linearised
from ...model.parameters import Parameters
from ...theory.critical import NoInstability, run_length
from ..keys import key_in
from ..time_left import TimeLeft, predicted_cost, step_cost

PARTS = (0.1, 0.2, 0.3, 0.5, 0.7, 0.9)
"""Parts of the runs after which the time left is asked for."""

PAUSE = 120.0
"""Time (s) without a run after which the next one belongs to another start of the workflow."""

FEWEST = 20
"""Runs without such a pause, below which nothing is said."""


class Ran(NamedTuple):
    """A run as it was: predicted cost, the times (s) at which it began and ended, and its steps."""

    name: str
    cost: float
    begin: float
    end: float
    work: float  # its steps, times the time of a step over that of others


def runs_of(results: Path) -> list[Ran]:
    """The runs in a directory of results."""
    found = []
    for path in (results / "simulations").glob("[!.]*.nc"):
        if key_in(path):
            said = netcdf.attributes(path)
            parameters = Parameters.from_dict(json.loads(said["parameters"]))
            end = datetime.datetime.fromisoformat(said["created"]).timestamp()
            begin = end - float(said["wall_seconds"])
            cost = predicted_cost(parameters, _theory_length(parameters))
            work = float(said["steps"]) * step_cost(parameters)
            found.append(Ran(path.name, cost, begin, end, work))
    return found


def _theory_length(parameters: Parameters) -> float:
    try:
        return run_length(parameters, linearised(parameters.friction, parameters.loading))
    except NoInstability:
        return float("nan")


def by_steps(runs: list[Ran]) -> list[Ran]:
    """The same runs, in their order on as many cores, each as long as its steps take."""
    runs = sorted(runs, key=lambda run: run.begin)
    busy, elapsed = sum(run.end - run.begin for run in runs), _last(runs) - runs[0].begin
    second = busy / sum(run.work for run in runs)
    free, found = [0.0] * max(round(busy / elapsed), 1), []
    for run in runs:
        begin = heapq.heappop(free)
        end = begin + second * run.work
        heapq.heappush(free, end)
        found.append(run._replace(begin=begin, end=end))
    return found


def _last(runs: Iterable[Ran]) -> float:
    return max(run.end for run in runs)


def sessions(runs: Iterable[Ran]) -> list[list[Ran]]:
    """The runs of each start of the workflow, told apart by pauses."""
    found: list[list[Ran]] = []
    latest = -float("inf")
    for run in sorted(runs, key=lambda run: run.begin):
        if run.begin > latest + PAUSE:
            found.append([])
        found[-1].append(run)
        latest = max(latest, run.end)
    return [session for session in found if len(session) >= FEWEST]


def errors(runs: list[Ran], parts: tuple[float, ...] = PARTS) -> list[float]:
    """The time left that was told after parts of the runs, over what was left, less one."""
    last = _last(runs)
    left = TimeLeft({run.name: run.cost for run in runs})
    wanted, done, found = [max(int(part * len(runs)), 1) for part in parts], 0, []
    events = [(run.begin, True, run.name) for run in runs]
    events += [(run.end, False, run.name) for run in runs]
    for moment, begins, name in sorted(events):
        if begins:
            left.begins(name, moment)
            left.seconds(moment)
            continue
        left.ends(name, moment)
        done += 1
        if done in wanted:
            told = left.seconds(moment)
            found.append((told or 0.0) / (last - moment) - 1.0 if last > moment else 0.0)
    return found


def report(results: Path) -> str:
    """A table of all sessions in a directory of results."""
    head = "".join(f"{100 * part:8.0f} %" for part in PARTS)
    lines = [
        f"Error of the time left after a part of the runs\n{'runs':>6}{'hours':>8}{'':12}{head}"
    ]
    for runs in sessions(runs_of(results)):
        for how, ran in (("as it was", runs), ("by steps", by_steps(runs))):
            hours = (_last(ran) - min(run.begin for run in ran)) / 3600.0
            told = "".join(f"{100.0 * error:+8.0f} %" for error in errors(ran))
            lines.append(f"{len(ran):6}{hours:8.2f}  {how:10}{told}")
    return "\n".join(lines) if len(lines) > 2 else f"There are no {FEWEST} runs in {results}"
