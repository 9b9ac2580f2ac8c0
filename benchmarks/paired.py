"""A run's processor time here over that at an earlier commit, the two taking turns.

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
from nucleation.analysis.extraction import extract
from nucleation.configuration.load import load
from nucleation.simulation.run import simulate

runs = {run.id: run for run in load("config/config.yaml").runs}
parameters = runs[sys.argv[1]].parameters
simulate(parameters.replaced({"n_x": 16, "n_y": 4, "end_time": 1e-3}))  # compiles what is compiled
start = time.process_time()
record = simulate(parameters)
seconds = time.process_time() - start
found = extract(record)
print(json.dumps({
    "seconds": seconds, "steps": record.attrs["steps"] + record.attrs["rejected_steps"],
    "onset_time": found["onset_time"], "length": found["length"],
}))
"""


def measured(source: Path, run: str) -> dict[str, float]:
    """Processor time (s), steps, onset (s) and length (m) of one run by the code in a directory."""
    environment = os.environ | {"PYTHONPATH": str(source / "src"), "OMP_NUM_THREADS": "1"}
    said = subprocess.run(
        [sys.executable, "-c", MEASURE, run], cwd=source, env=environment, check=True,
        stdout=subprocess.PIPE, text=True,
    )  # fmt: skip
    found: dict[str, float] = json.loads(said.stdout)
    return found


def paired(commit: str, run: str = RUN, turns: int = TURNS) -> dict[str, Any]:
    """The fastest run of each code and the ratio of a step's time, here over there.

    Raises
    ------
    subprocess.CalledProcessError
        If there is no such commit or run, or a run fails.
    """
    with tempfile.TemporaryDirectory(prefix="nucleation-bench-") as name:
        earlier = Path(name)
        archive = subprocess.run(
            ["git", "archive", commit, "src", "config"],
            cwd=CHECKOUT,
            check=True,
            stdout=subprocess.PIPE,
        )
        subprocess.run(["tar", "-x", "-C", name], input=archive.stdout, check=True)
        found: dict[str, list[dict[str, float]]] = {"before": [], "now": []}
        for _ in range(turns):
            found["before"].append(measured(earlier, run))
            found["now"].append(measured(CHECKOUT, run))
    best = {name: min(each, key=lambda one: one["seconds"]) for name, each in found.items()}
    per_step = {name: one["seconds"] / one["steps"] for name, one in best.items()}
    return best | {"step_now_over_before": per_step["now"] / per_step["before"]}


def main() -> None:
    """Print both measurements of a run and their ratio."""
    parser = argparse.ArgumentParser(prog="benchmarks.paired", description=main.__doc__)
    parser.add_argument("commit")
    parser.add_argument("--run", default=RUN, help="identifier of a run of config/config.yaml")
    parser.add_argument("--turns", type=int, default=TURNS)
    arguments = parser.parse_args()
    print(json.dumps(paired(arguments.commit, arguments.run, arguments.turns), indent=2))


if __name__ == "__main__":
    main()
