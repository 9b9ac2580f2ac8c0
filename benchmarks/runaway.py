"""``python -m benchmarks.runaway [DRAWS]``: how far L_run depends on how it is found.

Each fault's L_run is the mean over moduli that differ in the last bits. The error that is stated
has to cover each draw, and each length with other settings; the last column is the largest
deviation over k_b/k_c, which ``ERROR`` of the module is to exceed. Some ten minutes on one core.
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
    "friction": 0.41,
}
HALF_SPACES = {"height": math.inf}
UNLIKE = {"second_shear_modulus": 9.3e9, "second_poisson_ratio": 0.25}
BODIES: dict[str, dict[str, Any]] = {
    "thin layer": {"second_shear_modulus": math.inf, "height": 1e-5, "friction": 0.0},
    "layer": {"second_shear_modulus": math.inf, "height": 0.02},
    "unlike pair": {"height": 0.02, "second_height": 0.01} | UNLIKE,
    "half-spaces": HALF_SPACES,
    "unlike half-spaces": HALF_SPACES | UNLIKE,
}
FAULTS = (
    ("thin layer", "aging", 0.2),
    ("thin layer", "slip", 0.5),
    ("layer", "aging", 0.3),
    ("unlike pair", "aging", 0.3),
    ("unlike pair", "slip", 0.5),
    ("half-spaces", "aging", 0.2),
    ("half-spaces", "aging", 0.3),
    ("half-spaces", "slip", 0.5),
    ("unlike half-spaces", "aging", 0.5),
)
"""Bodies, evolution and zeta/a: from the cheapest to what takes some seconds for each length."""

CHANGES: dict[str, list[tuple[ModuleType, str, Any]]] = {
    "last bits": [],
    "half the duration": [(runaway, "DURATION", 0.5 * runaway.DURATION)],
    "twice the duration": [(runaway, "DURATION", 2.0 * runaway.DURATION)],
    "half the disturbances": [(runaway, "DISTURBANCES", (0.0025, 0.01))],
    "twice the disturbances": [(runaway, "DISTURBANCES", (0.01, 0.04))],
    "twice the modes": [
        (slow_slip, "FINENESS", 2.0 * slow_slip.FINENESS),
        (slow_slip, "MODES_OF_ENDS", 2 * slow_slip.MODES_OF_ENDS),
    ],
    "a tenth of the tolerance": [(slow_slip, "TOLERANCE", 0.1 * slow_slip.TOLERANCE)],
}
LIMITS: list[tuple[ModuleType, str, Any]] = [
    (slow_slip, "MOST_MODES", 3 * slow_slip.MOST_MODES),
    (slow_slip, "MOST_STEPS", 3 * slow_slip.MOST_STEPS),
]
"""Limits up to which an answer is given: a change may need more."""


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


def main(draws: int = 4) -> None:
    """Print a line for each fault and change."""
    print(f"{'bodies':19}{'evolution':10}{'zeta/a':>7}  {'change':25}{'L_run/L_c':>10}", end="")
    print(f"{'largest':>9}{'stated':>8}{'/(k_b/k_c)':>12}")
    for bodies, evolution, ratio in FAULTS:
        _of_fault(bodies, evolution, ratio, draws)


def _of_fault(bodies: str, evolution: str, ratio: float, draws: int) -> None:
    """The lines of one fault."""
    given = SHARED | BODIES[bodies] | {"evolution": evolution, "zeta": ratio * SHARED["a"]}
    usual = math.nan
    for change, settings in CHANGES.items():
        found = []
        for draw in range(1 if settings else draws):
            modulus = SHARED["shear_modulus"] * (1.0 + draw * 2.0**-52)
            fault = Fault(**given | {"shear_modulus": modulus})
            critical = float(fault.critical_length())
            patches = Patches(single_system(fault), evolution=evolution)
            with _changed([*settings, *LIMITS]):
                length, error = runaway.runaway_point(patches, critical)
            found.append(length / critical)
        usual = usual if settings else float(np.mean(found))
        fronts = slow_slip.cohesive_wavenumber(patches, critical) * critical / (2.0 * math.pi)
        largest = float(np.abs(np.log(np.array(found) / usual)).max())
        print(
            f"{bodies:19}{evolution:10}{ratio:7.3g}  {change:25}{np.mean(found):10.4f}"
            f"{largest:9.4f}{error:8.4f}{largest / fronts:12.4f}",
            flush=True,
        )


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
