"""``python -m benchmarks.arrays``: what lengths of many faults cost, in processor time.

Faults that share their ratios, here those that differ in normal stress alone, share one problem.
Each question is asked for other ratios, so that nothing of it is known from the one before.
"""

import time
from collections.abc import Callable
from typing import Any

import numpy as np

from nucleation.api import Fault

NUMBERS = 1, 10, 2000
GRANITE: dict[str, Any] = {
    "shear_modulus": 30e9,
    "poisson_ratio": 0.25,
    "a": 0.010,
    "slip_distance": 5e-6,
}
QUESTIONS: dict[str, Callable[[Fault], Any]] = {
    "L_c": Fault.critical_length,
    "literature": Fault.literature,
    "L_s": Fault.stability_length,
    "lengths(perturbation='none')": lambda fault: fault.lengths("none"),
    "L_run": Fault.runaway_length,
    "W_c": lambda fault: fault.weakening_patch_length(-0.005),
    "lengths()": Fault.lengths,
    "lengths() with f and V": lambda fault: fault.replace(friction=0.6, velocity=1e-6).lengths(),
}
FIRST, STEP = 0.013, 1e-5  # of b, which no two questions share


def faults(number: int, b: float) -> Fault:
    """Half-spaces under as many normal stresses."""
    return Fault(**GRANITE, b=b, normal_stress=np.linspace(10e6, 100e6, number))


def main() -> None:
    """Print a line for each question, with a column for each number of faults."""
    for ask in QUESTIONS.values():  # what all of them share: modules, tables
        ask(faults(1, FIRST - STEP))
    print(f"{'processor time (s) of faults':32}", *(f"{number:>8}" for number in NUMBERS))
    b = FIRST
    for name, ask in QUESTIONS.items():
        times = []
        for number in NUMBERS:
            asked = faults(number, b)
            b += STEP
            begin = time.process_time()
            ask(asked)
            times.append(time.process_time() - begin)
        print(f"{name:32}", *(f"{seconds:8.3f}" for seconds in times), flush=True)


if __name__ == "__main__":
    main()
