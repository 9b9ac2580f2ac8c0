"""Settings of the theory's curves: where they are computed."""

import dataclasses

import numpy as np

from ..model.quantities import quantity
from ..model.units import Checked


def _rounded(values: np.ndarray) -> tuple[float, ...]:
    return tuple(float(f"{x:.6g}") for x in values)


@dataclasses.dataclass(frozen=True)
class Curves(Checked):
    """Where the theory's curves are computed."""

    heights: tuple[float, ...] = quantity(
        "block heights of the theory's curve in Figure 3",
        "(0.0, 1e6) m",
        symbol="H",
        default=_rounded(np.geomspace(0.003, 0.15, 80)),
    )
    f_beta: tuple[float, ...] = quantity(
        "friction coefficient times bimaterial contrast in Figure 2",
        "(-10.0, 10.0)",
        symbol="f beta",
        default=_rounded(np.linspace(0.0, 0.5, 101)),
    )
    zeta_over_a: tuple[float, ...] = quantity(
        "velocity weakening over direct effect in Figure 2",
        "(0.0, 1e6)",
        symbol="zeta/a",
        default=(0.1, 0.3, 1.0, 3.0, 10.0),
    )
    slip_rates: tuple[float, ...] = quantity(
        "slip rates of steady sliding in Figure S1",
        "(0.0, 1e4) m/s",
        symbol="v",
        default=_rounded(np.geomspace(1e-11, 1e1, 241)),
    )
