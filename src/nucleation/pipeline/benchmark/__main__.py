"""``python -m nucleation.pipeline.benchmark CONFIGURATION [PART ...]``."""

from __future__ import annotations

import argparse
import json
import os
from pathlib import Path
from typing import Any

from ...configuration.load import Configuration, load
from ...datasets.files import replacing
from ...figures import style
from ...figures.checks import work_precision
from ...model.parameters import Parameters
from ...simulation.run import simulate
from . import batched, overhead, replay, scale
from .runs import precisions, speedup_over_sparse, whole_run
from .steps import pair_steps, perturbed, scaling, step_over_solve
from .timing import with_mesh

PARTS = ("solver", "scale", "overhead", "progress")


def benchmark(parameters: Parameters) -> dict[str, Any]:
    """All measurements of one simulation, the one of Figure S2."""
    simulate(with_mesh(parameters, 16, 4))  # compiles what is compiled
    whole = whole_run(parameters)  # first: the memory is that of the process
    return {
        **whole,
        **step_over_solve(parameters),
        **speedup_over_sparse(parameters, whole),
        **scaling(parameters),
        **pair_steps(parameters),
        **perturbed(parameters),
        "work_precision": precisions(parameters),
        "threads": os.environ.get("OMP_NUM_THREADS", "not set"),
    }


def report(result: dict[str, Any]) -> str:
    """The solver's measurements as a table."""
    lines = []
    for name, value in result.items():
        if name == "work_precision":
            lines.append("tolerance  longest step  steps  seconds  onset error")
            lines += [
                f"{row['tolerance']:9g}  {row['longest_step']:12g}  {row['steps']:5d}  "
                f"{row['seconds']:7.1f}  {row['onset_error']:11.1e}"
                for row in value
            ]
        elif isinstance(value, dict):
            lines.append(f"{name:32}" + "  ".join(f"{k}: {v:.3g}" for k, v in value.items()))
        else:
            lines.append(f"{name:32}{value if isinstance(value, str) else format(value, '.4g')}")
    return "\n".join(lines)


def write_json(result: dict[str, Any], path: Path) -> None:
    """Write measurements for machines."""
    with replacing(path) as temporary:
        temporary.write_text(json.dumps(result, indent=2) + "\n", encoding="utf-8")


def measure_solver(settings: Configuration, results: Path) -> None:
    """Print the solver's speed, and write bench.json and the work-precision diagram."""
    parameters = settings.shown(settings.figures.space_time_height).parameters
    result = benchmark(parameters)
    print(report(result), flush=True)
    write_json(result, results / "bench.json")
    style.save(work_precision.draw(result["work_precision"]), results / "figures/work_precision")


def measure_scale(numbers: tuple[int, ...], results: Path) -> None:
    """Print what surrounds thousands of runs, and write bench_scale.json."""
    result = {}
    for runs in numbers:
        result[str(runs)] = scale.in_new_directory(scale.measured, runs)
        result[f"{runs} in batches"] = scale.in_new_directory(batched.measured, runs)
    print(scale.report(result), flush=True)
    write_json(result, results / "bench_scale.json")


def measure_overhead(settings: Configuration, results: Path, profile: str) -> None:
    """Print what a run costs beside its steps and on the disk, and write bench_overhead.json."""
    (run, *_) = settings.runs_for("map")
    result = overhead.overhead(run.parameters, profile)
    print(overhead.report(result), flush=True)
    write_json(result, results / "bench_overhead.json")


def main() -> None:
    """Measure the parts that are asked for, all if none is; print and write what was found."""
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("configuration", type=Path)
    parser.add_argument("parts", nargs="*", help=f"of {', '.join(PARTS)}")
    parser.add_argument("--runs", type=int, nargs="+", default=scale.RUNS,
                        help="in the studies of the part scale, multiples of 50")  # fmt: skip
    parser.add_argument(
        "--profile", default="default", help="of workflow/profiles, for the part overhead"
    )
    arguments = parser.parse_args()
    if unknown := set(arguments.parts) - set(PARTS):
        parser.error(f"unknown parts {sorted(unknown)}: there are {', '.join(PARTS)}")
    if any(runs < scale.SMALLEST or runs % scale.SMALLEST for runs in arguments.runs):
        parser.error(f"--runs: {arguments.runs} must be multiples of {scale.SMALLEST}")
    settings = load(arguments.configuration)
    results = Path(settings.results)
    parts = arguments.parts or PARTS
    if "solver" in parts:
        measure_solver(settings, results)
    if "scale" in parts:
        measure_scale(tuple(arguments.runs), results)
    if "overhead" in parts:
        measure_overhead(settings, results, arguments.profile)
    if "progress" in parts:
        print(replay.report(results), flush=True)


if __name__ == "__main__":
    main()
