"""``K + s M`` of one layer, eliminated mode by mode from the far side down to the interface."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ..types import Array
from . import kernels
from .grid import Field
from .layer import Layer
from .right_edge import RightEdge


class Before(NamedTuple):
    """Displacements (m) before a step with ``u = c1 u_1 + c2 u_2 + beta du/dt``."""

    coefficients: Sequence[float]  # c1 and c2
    beta: float  # s
    newest: Field
    oldest: Field


class LayerFactors:
    """``K + s M`` of a layer for one ``s`` (1/s^2), eliminated mode by mode down to its interface.

    `pivot` is the stiffness on the interface per mode, times 2/n_x (N/m per m): xx, xy, yy.
    """

    def __init__(self, layer: Layer, s: float) -> None:
        self.layer = layer
        modes = layer.modes
        material = layer.material
        density = s * material.density
        self.pivot = np.empty((3, modes.n_x))
        self.inverse = np.zeros((layer.levels, 3, modes.n_x))
        self.lower = np.empty((layer.levels - 1, 4, modes.n_x))
        kernels.factorise(
            material.p_wave_modulus * modes.x_stiffness + density * modes.x_mass,
            material.shear_modulus * modes.x_mass,
            material.shear_modulus * modes.x_stiffness + density * modes.x_mass,
            material.p_wave_modulus * modes.x_mass,
            modes.sine,
            layer.mass,
            layer.stiffness,
            layer.derivative,
            material.lame_modulus,
            material.coupling_modulus,
            layer.held,
            self.pivot,
            self.inverse,
            self.lower,
        )
        self.edge = (
            RightEdge(
                layer,
                s,
                self.inverse,
                self.lower,
            )
            if modes.has_edge
            else None
        )

    @property
    def megabytes(self) -> float:
        """Memory that the factors hold once all of their parts are in use (MB)."""
        levels = self.layer.levels
        return 8e-6 * levels * (9 * self.layer.modes.n_x + 2 * levels)

    def sweep_down(
        self,
        load: Field,
        edge: Array,
        out: Array,
    ) -> None:
        """Fill `out` with a load (N/m) swept to the interface, with given edge values (m)."""
        profiles = np.zeros((3, edge.size)) if self.edge is None else self.edge.profiles(edge)
        modes = self.layer.modes
        kernels.eliminate(
            self.lower,
            load.modes,
            profiles,
            modes.edge_weights,
            modes.scale,
            out,
        )

    def substitute(self, modes: Array) -> None:
        """Sweep a swept load back from the interface's displacement in level 0, in place.

        At least the two lowest levels are given.
        """
        levels = len(modes)
        kernels.substitute(
            self.inverse[:levels],
            self.lower[: levels - 1],
            modes,
        )

    def move(
        self,
        before: Before,
        modes: Array,
        newest: Array,
        oldest: Array,
        rate: Array,
    ) -> None:
        """Sweep a swept load back likewise, and fill `rate` (m/s) by the step's formula."""
        c1, c2 = before.coefficients
        beta = before.beta
        kernels.move(
            self.inverse,
            self.lower,
            modes,
            c1,
            c2,
            beta,
            newest,
            oldest,
            rate,
        )
