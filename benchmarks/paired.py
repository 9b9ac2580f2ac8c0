"""Times of whole commands here and at an earlier commit, in turns, and their ratios.

    python -m benchmarks.paired 01c05321 [--parts length plan ...] [--turns 3]

Each commit is cloned, and its environment made by its own `make install`. A part runs in both
clones in turns, so that a machine that gets slower does so for both. Times of the first turn
include the compilation of kernels only in the parts `install` and `paper`, which start from
nothing.
"""

import argparse
import json
import os
import resource
import shlex
import statistics
import subprocess
import tempfile
import time
from pathlib import Path
from typing import NamedTuple

CHECKOUT = Path(__file__).parents[1]

FAULT = (
    "--shear-modulus 30GPa --poisson-ratio 0.25 --normal-stress 50MPa --a 0.010 --b 0.015 "
    "--slip-distance 5um"
)
WEAK = {
    "shear_modulus": 30e9,
    "poisson_ratio": 0.25,
    "normal_stress": 50e6,
    "a": 0.010,
    "b": 0.015,
    "slip_distance": 5e-6,
    "height": 0.5,
}
RUNAWAY = f"""
from nucleation import api
fault = api.Fault(**{WEAK})
print(fault.runaway_length())
"""
RUN = """
from importlib import import_module
from importlib.util import find_spec
package = "replication" if find_spec("replication") else "nucleation"
load = import_module(package + ".configuration.load").load
from nucleation.simulation.run import simulate
found = load("config/config.yaml").run("converged-aging-H0.02-phi1-seed1")
simulate(getattr(found, "run", None) or found.parameters)
"""
PLAN = """
studies:
  large:
    defaults: {n_x: 20, n_y: 4, block_length: 1.0, end_time: 1.0e-3}
    runs:
      - height: {start: 0.01, stop: 0.1, num: 5000}
"""
NOTHING = "git clean -fdxq results; rm -rf .snakemake"

PARTS = {
    "install": ("rm -rf .venv", "make install"),
    "paper": (f"{NOTHING}; rm -rf .venv", "make paper"),
    "workflow": (NOTHING, "make paper"),
    "length": ("", f".venv/bin/nucleation length {FAULT}"),
    "runaway": ("", "PYTHONPATH=src .venv/bin/python runaway.py"),
    "run": ("", "PYTHONPATH=src .venv/bin/python run.py"),
    "plan": ("", ".venv/bin/snakemake -n lengths --quiet all --configfile plan.yaml"),
    "test": ("", "make test"),
}
"""Commands that are not timed, and the command that is."""

USUAL = ("length", "runaway", "run", "plan", "workflow", "paper")


class Times(NamedTuple):
    """Wall time and processor time (s) of a command with all its children."""

    wall: float
    processor: float


def timed(part: str, clone: Path) -> Times:
    """Run a part once in a clone."""
    before, command = PARTS[part]
    run(before, clone)
    used = _processor_time()
    start = time.perf_counter()
    run(command, clone)
    return Times(time.perf_counter() - start, _processor_time() - used)


def run(command: str, folder: Path) -> None:
    """Run a command of the shell in a folder, without its output."""
    subprocess.run(
        ["bash", "-c", command],
        cwd=folder,
        env=os.environ | {"OMP_NUM_THREADS": "1"},
        check=True,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )


def _processor_time() -> float:
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def clone_of(commit: str, folder: Path) -> Path:
    """A clone of the checkout at a commit, with its environment."""
    run(f"git clone --quiet . {shlex.quote(str(folder))}", CHECKOUT)
    run(f"git checkout --quiet {shlex.quote(commit)}", folder)
    (folder / "runaway.py").write_text(RUNAWAY)
    (folder / "run.py").write_text(RUN)
    (folder / "plan.yaml").write_text(PLAN)
    run("make install", folder)
    return folder


def main() -> None:
    """Print medians of both commits and their ratio, now over before, for each part."""
    parser = argparse.ArgumentParser(prog="benchmarks.paired", description=main.__doc__)
    parser.add_argument("commit")
    parser.add_argument("--parts", nargs="+", choices=PARTS, default=USUAL)
    parser.add_argument("--turns", type=int, default=3)
    given = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="nucleation-bench-") as folder:
        clones = [
            clone_of(commit, Path(folder, name))
            for name, commit in (("before", given.commit), ("now", "HEAD"))
        ]
        for part in given.parts:
            if part not in ("install", "paper", "workflow", "test"):
                for clone in clones:
                    timed(part, clone)  # compiles kernels, fills caches
            turns = [[timed(part, clone) for clone in clones] for _ in range(given.turns)]
            found: dict[str, object] = {"part": part}
            for which in Times._fields:
                before, now = (
                    statistics.median(getattr(turn[i], which) for turn in turns) for i in (0, 1)
                )
                found[which] = {
                    "before": round(before, 2),
                    "now": round(now, 2),
                    "ratio": round(now / before, 3),
                }
            print(json.dumps(found), flush=True)


if __name__ == "__main__":
    main()
