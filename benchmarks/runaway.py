"""``python -m benchmarks.runaway [DRAWS]``: how far L_run depends on how it is found.

Each fault's L_run is the mean over moduli that differ in the last bits. The error that is stated
has to cover each draw, and each draw with other settings; the last column is the largest deviation
over k_b/k_c, which ``ERROR`` of the module is to exceed. Some ten minutes on one core.
"""

import math
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from types import ModuleType
from typing import Any

import numpy as np

from nucleation.api import Fault
from nucleation.theory.creep import runaway, slow_slip
from nucleation.theory.creep.patches import Patches
from nucleation.theory.evaluation import single_system

SHARED = {
    "shear_modulus": 3.1e9,
    "poisson_ratio": 1.0 / 3.0,
    "normal_stress": 1e6,
    "a": 0.0068,
    "slip_distance": 5e-7,
}
THIN = {"second_shear_modulus": math.inf, "height": 1e-5, "friction": 0.0}
PAIR = {"height": 0.02, "friction": 0.41}
HALF_SPACES = {"height": math.inf, "friction": 0.41}
BODIES: dict[str, dict[str, Any]] = {"thin": THIN, "pair": PAIR, "half-spaces": HALF_SPACES}
WEAKENINGS = 0.15, 0.2, 0.3, 0.5, 1.5  # zeta/a
CHANGES: dict[str, list[tuple[ModuleType, str, Any]]] = {
    "last bits": [],
    "half the duration": [(runaway, "DURATION", 0.5 * runaway.DURATION)],
    "twice the duration": [
        (runaway, "DURATION", 2.0 * runaway.DURATION),
        (slow_slip, "MOST_STEPS", 2 * slow_slip.MOST_STEPS),
    ],
    "half the disturbances": [(runaway, "DISTURBANCES", (0.0025, 0.01))],
    "twice the disturbances": [(runaway, "DISTURBANCES", (0.01, 0.04))],
    "twice the modes": [
        (slow_slip, "FINENESS", 2.0 * slow_slip.FINENESS),
        (slow_slip, "MODES_OF_ENDS", 2 * slow_slip.MODES_OF_ENDS),
        (slow_slip, "MOST_MODES", 2 * slow_slip.MOST_MODES),
        (slow_slip, "MOST_STEPS", 2 * slow_slip.MOST_STEPS),
    ],
    "a tenth of the tolerance": [(slow_slip, "TOLERANCE", 0.1 * slow_slip.TOLERANCE)],
}


@contextmanager
def _changed(settings: list[tuple[ModuleType, str, Any]]) -> Iterator[None]:
    """Other values of modules' constants for a while."""
    before = [(module, name, getattr(module, name)) for module, name, _ in settings]
    for module, name, value in settings:
        setattr(module, name, value)
    try:
        yield
    finally:
        for module, name, value in before:
            setattr(module, name, value)


def main(draws: int = 6) -> None:
    """Print a line for each fault and change."""
    print(f"{'bodies':12}{'evolution':10}{'zeta/a':>7}  {'change':26}{'mean':>8}{'sd':>8}", end="")
    print(f"{'largest':>9}{'stated':>8}{'/(k_b/k_c)':>12}")
    for bodies, own in BODIES.items():
        for evolution in ("aging", "slip"):
            for ratio in WEAKENINGS:
                _of_fault(bodies, SHARED | own | {"evolution": evolution}, ratio, draws)


def _of_fault(bodies: str, given: dict[str, Any], ratio: float, draws: int) -> None:
    """The lines of one fault."""
    usual = math.nan
    for change, settings in CHANGES.items():
        found = []
        for draw in range(draws if not settings else max(2, draws // 3)):
            modulus = given["shear_modulus"] * (1.0 + draw * 2.0**-52)
            fault = Fault(**given | {"shear_modulus": modulus, "zeta": ratio * given["a"]})
            critical = float(fault.critical_length())
            patches = Patches(single_system(fault), evolution=given["evolution"])
            with _changed(settings):
                length, error = runaway.runaway_point(patches, critical)
            found.append(length / critical)
        usual = float(np.mean(found)) if not settings else usual
        fronts = slow_slip.cohesive_wavenumber(patches, critical) * critical / (2.0 * math.pi)
        largest = float(np.abs(np.log(np.array(found) / usual)).max())
        print(
            f"{bodies:12}{given['evolution']:10}{ratio:7.3g}  {change:26}{np.mean(found):8.4f}"
            f"{np.std(found, ddof=1) / usual:8.4f}{largest:9.4f}{error:8.4f}"
            f"{largest / fronts:12.4f}",
            flush=True,
        )


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
