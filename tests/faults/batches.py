"""Many runs in one job: a small map, killed in the middle of a batch, and run again."""

from __future__ import annotations

import contextlib
import functools
import random
import signal
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import pandas as pd
import psutil
import xarray as xr
import yaml
from harness import COSTS, Place, Reference
from processes import Running, processor_time, require
from registry import RECOVERED, fault

from nucleation.configuration.load import load

HEIGHTS, WEAKENINGS = [0.02, 0.1], [3.0, 5.0]
RUNS = len(HEIGHTS) * len(WEAKENINGS)
CONFIG = {
    "studies": {
        "map": {
            "role": "map",
            "table": "own",
            "runs_per_job": RUNS,
            "measure": "stability",
            "length_over_critical": 4.0,
            "defaults": {
                "n_x": 80, "n_y": 4, "grading": 6.0, "time_after_event": 0.0, "record": "lengths",
                "perturbation": "normal_load", "strength": 1e-3, "friction_coefficient": 0.41,
                "direct_effect": 0.0068, "tolerance": 0.1, "longest_step": 0.2,
            },
            "runs": [{"height": HEIGHTS, "zeta_over_a": WEAKENINGS}],
        }
    }
}  # fmt: skip
MAP = "figure_map"


class Map(NamedTuple):
    """A finished map: its datasets, its table without what tells of the machine, and its cost."""

    contents: dict[str, xr.Dataset]
    table: pd.DataFrame
    cpu: float  # s of processor time


def _beginning(directory: Path) -> Place:
    """A place in which nothing of the map is made yet."""
    directory.mkdir()
    (directory / "config.yaml").write_text(yaml.safe_dump(CONFIG))
    return Place(directory)


def _table(place: Place) -> pd.DataFrame:
    table = pd.read_csv(place.results / "map.csv", dtype=str)  # texts: to the last digit
    return table.drop(columns=[name for name in table if name in COSTS])


@functools.cache
def _undisturbed(directory: Path) -> Map:
    """The map, made at one go beside the workflows of a reference."""
    place = _beginning(directory / "map")
    done = place.start(MAP).end()
    require(done.status == 0, done.output)
    return Map(place.contents(), _table(place), done.cpu)


def _finished(place: Place) -> dict[str, bytes]:
    """The datasets of the runs that are done, with when they were made, by their ids."""
    paths = {run.id: place.simulation(run.id) for run in load(place.directory / "config.yaml").runs}
    return {id: path.read_bytes() for id, path in paths.items() if path.exists()}


def _kill_in_a_batch(
    place: Place, reference: Reference, random: random.Random, kill: Callable[[Running], None],
    *, dies: bool = True,
) -> str:  # fmt: skip
    """Kill within a run after the first, run again: the map is the same, finished runs are kept.

    `dies`: whether what makes the runs is killed; if not it goes on beside the next one.
    """
    whole = _undisturbed(reference.directory.parent)
    own = _beginning(place.directory / "map")
    running, first = own.start(MAP), random.randrange(1, RUNS)
    if running.wait_for(lambda: len(_finished(own)) >= first):
        running.spend(processor_time(running.tree()) + random.uniform(0.0, 0.1) * whole.cpu)
        kill(running)
    stopped = running.end().status != 0
    kept = _finished(own)
    checkpoints = own.results.glob("unfinished/[!.]*.checkpoint.npz")
    halves = [path for path in checkpoints if path.name.rsplit(".", 3)[0] not in kept]
    require(not dies or stopped or len(kept) == RUNS, "it ended well without all runs")
    own.finish(MAP)
    after = _finished(own)
    require(len(after) == RUNS, f"there are {len(after)} runs")
    if dies:
        again = {id for id in after if after[id] != kept.get(id)}
        require(len(again) == RUNS - len(kept), f"{len(again)} runs made, {len(kept)} were there")
        said = "".join(path.read_text() for path in own.results.glob("logs/batches/*.log"))
        require(said.count("the run goes on from") == len(halves), f"no checkpoint used: {said}")
    own.require_contents(whole.contents)
    pd.testing.assert_frame_equal(_table(own), whole.table)
    return RECOVERED


def _kill_scripts(running: Running) -> None:
    for process in running.scripts():
        with contextlib.suppress(psutil.NoSuchProcess):  # it has just ended
            process.kill()


for _name, _kill, _dies in (
    ("sigkill_batch", _kill_scripts, True),
    ("sigkill_snakemake_and_its_batch", lambda r: r.signal(signal.SIGKILL, group=True), True),
    # its batch goes on while the next workflow makes the same runs
    ("sigkill_snakemake_of_a_batch", lambda r: r.signal(signal.SIGKILL), False),
):
    fault("SIGKILL in a batch", _name)(functools.partial(_kill_in_a_batch, kill=_kill, dies=_dies))
