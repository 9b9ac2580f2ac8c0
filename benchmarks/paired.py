"""A run's processor time here over that at an earlier commit, both measured in turns.

``python -m benchmarks.paired 8b1871d [--run ID] [--turns N]``, in a checkout with its history. Both
codes run in the present environment, each on its own configuration.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

CHECKOUT = Path(__file__).parents[1]
RUN = "converged-aging-H0.02-phi1-seed1"  # declared, 400 x 16
TURNS = 4

MEASURE = """
import json, sys, time
from nucleation.extraction.extraction import extract
from replication.configuration.load import load
from nucleation.simulation.run import simulate

runs = {run.id: run for run in load("config/config.yaml").runs}
parameters = runs[sys.argv[1]].parameters
simulate(parameters.replaced({"n_x": 16, "n_y": 4, "end_time": 1e-3}))  # compiles the kernels
start = time.process_time()
record = simulate(parameters)
seconds = time.process_time() - start
found = extract(record)
print(json.dumps({
    "seconds": seconds, "steps": record.attrs["steps"] + record.attrs["rejected_steps"],
    "onset_time": found["onset_time"], "length": found["length"],
}))
"""


def _measured(source: Path, run: str) -> dict[str, float]:
    """Processor time (s), steps, onset (s) and length (m) of one run by the code in a directory."""
    environment = os.environ | {"PYTHONPATH": str(source / "src"), "OMP_NUM_THREADS": "1"}
    done = subprocess.run(
        [sys.executable, "-c", MEASURE, run],
        cwd=source,
        env=environment,
        check=True,
        stdout=subprocess.PIPE,
        text=True,
    )
    found: dict[str, float] = json.loads(done.stdout)
    return found


def _unpack(commit: str, directory: str) -> None:
    """Write the code and the configuration of a commit into a directory."""
    archive = subprocess.run(
        ["git", "archive", commit, "src", "config"],
        cwd=CHECKOUT,
        check=True,
        stdout=subprocess.PIPE,
    )
    subprocess.run(
        ["tar", "-x", "-C", directory],
        input=archive.stdout,
        check=True,
    )


def paired(
    commit: str,
    run: str = RUN,
    turns: int = TURNS,
) -> dict[str, Any]:
    """Compare the time of a step here with that at an earlier commit.

    Parameters
    ----------
    commit : str
        The earlier commit.
    run : str
        Identifier of a run in both configurations.
    turns : int
        Number of runs of each code.

    Returns
    -------
    dict
        The fastest run of each code as ``before`` and ``now``, and ``step_now_over_before``.

    Raises
    ------
    subprocess.CalledProcessError
        If there is no such commit or run, or a run fails.
    """
    before = []
    now = []
    with tempfile.TemporaryDirectory(prefix="nucleation-bench-") as directory:
        _unpack(commit, directory)
        for _ in range(turns):
            before.append(_measured(Path(directory), run))
            now.append(_measured(CHECKOUT, run))
    best_before = min(before, key=_seconds)
    best_now = min(now, key=_seconds)
    return {
        "before": best_before,
        "now": best_now,
        "step_now_over_before": _per_step(best_now) / _per_step(best_before),
    }


def _seconds(run: dict[str, float]) -> float:
    return run["seconds"]


def _per_step(run: dict[str, float]) -> float:
    return run["seconds"] / run["steps"]


def main() -> None:
    """Print both measurements of a run and their ratio."""
    parser = argparse.ArgumentParser(prog="benchmarks.paired", description=main.__doc__)
    parser.add_argument("commit")
    parser.add_argument("--run", default=RUN, help="identifier of a run of config/config.yaml")
    parser.add_argument("--turns", type=int, default=TURNS)
    arguments = parser.parse_args()
    found = paired(arguments.commit, arguments.run, arguments.turns)
    print(json.dumps(found, indent=2))


if __name__ == "__main__":
    main()
