"""``python -m benchmarks CONFIGURATION [PART ...]``, in a checkout."""

import argparse
import json
from pathlib import Path
from typing import Any

from nucleation.datasets.files import replacing
from replication.configuration.load import load

from . import solver, workflow

PARTS = ("solver", "workflow")


def main() -> None:
    """Measure the given parts, by default all; print the results and write them."""
    parser = argparse.ArgumentParser(prog="benchmarks", description=main.__doc__)
    parser.add_argument("configuration", type=Path)
    parser.add_argument("parts", nargs="*", help=f"of {', '.join(PARTS)}")
    parser.add_argument(
        "--runs",
        type=int,
        nargs="+",
        default=workflow.RUNS,
        help="numbers of runs in the studies of the part workflow, multiples of 50",
    )
    arguments = parser.parse_args()
    unknown = set(arguments.parts) - set(PARTS)
    if unknown:
        parser.error(f"unknown parts {sorted(unknown)}: there are {', '.join(PARTS)}")
    if any(runs < workflow.SMALLEST or runs % workflow.SMALLEST for runs in arguments.runs):
        parser.error(f"--runs: {arguments.runs} must be multiples of {workflow.SMALLEST}")
    settings = load(arguments.configuration)
    parts = arguments.parts or PARTS
    directory = Path(settings.results)
    if "solver" in parts:
        measured = solver.measure_solver(solver.of_figure_s2(settings))
        print(solver.solver_table(measured), flush=True)
        _write(directory / "bench.json", measured)
    if "workflow" in parts:
        costs = workflow.measure_workflow(arguments.runs)
        print(workflow.workflow_table(costs), flush=True)
        _write(directory / "bench_workflow.json", costs)


def _write(path: Path, result: Any) -> None:
    text = json.dumps(result, indent=2) + "\n"
    with replacing(path) as temporary:
        temporary.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
