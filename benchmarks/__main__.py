"""``python -m benchmarks CONFIGURATION [PART ...]``, in a checkout."""

import argparse
import json
from pathlib import Path

from nucleation.configuration.load import load
from nucleation.datasets.files import replacing

from . import solver, workflow

PARTS = ("solver", "workflow")


def main() -> None:
    """Measure the parts that are asked for, all if none is; print what was found and write it."""
    parser = argparse.ArgumentParser(prog="benchmarks", description=main.__doc__)
    parser.add_argument("configuration", type=Path)
    parser.add_argument("parts", nargs="*", help=f"of {', '.join(PARTS)}")
    parser.add_argument("--runs", type=int, nargs="+", default=workflow.RUNS,
                        help="in the studies of the part workflow, multiples of 50")  # fmt: skip
    arguments = parser.parse_args()
    if unknown := set(arguments.parts) - set(PARTS):
        parser.error(f"unknown parts {sorted(unknown)}: there are {', '.join(PARTS)}")
    if any(runs < workflow.SMALLEST or runs % workflow.SMALLEST for runs in arguments.runs):
        parser.error(f"--runs: {arguments.runs} must be multiples of {workflow.SMALLEST}")
    settings = load(arguments.configuration)
    parts = arguments.parts or PARTS
    found = {}
    if "solver" in parts:
        found["bench.json"] = solver.measured(solver.of_figure_s2(settings))
        print(solver.table(found["bench.json"]), flush=True)
    if "workflow" in parts:
        found["bench_workflow.json"] = workflow.measured(arguments.runs)
        print(workflow.table(found["bench_workflow.json"]), flush=True)
    for name, result in found.items():
        with replacing(Path(settings.results, name)) as temporary:
            temporary.write_text(json.dumps(result, indent=2) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
