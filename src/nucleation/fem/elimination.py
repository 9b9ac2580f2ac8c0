"""The bulk eliminated mode by mode, from the far side down to the interface.

A load is swept down to the interface; once the interface's displacement is known, the way back
gives that of the bulk. How the modes of the interface become its nodes is the same for one layer
and for two: :mod:`.condensed_nodes` with a free right edge, :mod:`.periodic` in a period.
"""

from abc import abstractmethod
from functools import cached_property

import numpy as np

from ..types import Array
from . import kernels
from .condensed import Operator
from .grid import Components, Field
from .separable import HELD, SeparableBody


class Elimination(Operator):
    """``K + s M`` of a body, condensed on the modes of its interface.

    Attributes
    ----------
    along_x : SeparableBody
        A layer with the modes.
    modal : ndarray
        D and N per mode, a right edge held, times 2/n_x (N/m per m), (2, modes).
    """

    along_x: SeparableBody
    modal: Array

    @abstractmethod
    def swept_down(self, load: Field, edge: Array) -> Array:
        """Sweep a load down to the interface.

        Parameters
        ----------
        load : Field
            The load (N/m).
        edge : ndarray
            Given edge values (m), shape (levels,).

        Returns
        -------
        ndarray
            The swept load (N/m), shape (levels, 2, modes).
        """

    @abstractmethod
    def reduced(self, swept: Array) -> tuple[Array, Array | None]:
        """Return the effect of a swept load at w = 0.

        Parameters
        ----------
        swept : ndarray
            The swept load (N/m), shape (levels, 2, modes).

        Returns
        -------
        reduced : ndarray
            This load is subtracted from the modal forces (N/m), shape (2, modes).
        start : ndarray or None
            Displacement of a pair's interface (m), shape (2, modes); None on a rigid base.
        """

    @abstractmethod
    def substitute_up(
        self,
        swept: Array,
        amplitudes: Array,
        start: Array | None,
    ) -> None:
        """Sweep back from the interface, in place.

        Parameters
        ----------
        swept : ndarray
            The swept load (N/m), shape (levels, 2, modes); the displacement (m) replaces it.
        amplitudes : ndarray
            Amplitudes of w at the interface (m), shape (modes,).
        start : ndarray or None
            As returned by :meth:`reduced`.
        """

    def apply(self, w: Array) -> Components:
        """Return ``D w`` at the free nodes and ``N w`` at the nodes 0..n_x (N/m), for w (m)."""
        amplitudes = self.along_x.sine_amplitudes(w)
        return self.along_x.forces(self.modal, amplitudes, self._no_load)

    @cached_property
    def _no_load(self) -> Array:
        return np.zeros(self.modal.shape)


class SeparableOperator(Elimination):
    """``K + s M`` of one layer for one ``s`` (1/s^2), with ``s = 0`` for statics.

    Attributes
    ----------
    pivot : ndarray
        Stiffness on the interface per mode, times 2/n_x (N/m per m): xx, xy, yy, (3, modes).
    """

    body: SeparableBody

    def __init__(self, body: SeparableBody, s: float) -> None:
        self.body = body
        self.along_x = body
        self.s = s
        grid = body.grid
        material = body.material
        density = s * material.density
        self.pivot = np.empty((3, body.modes))
        self._inverse = np.zeros((grid.n_y + 1, 3, body.modes))
        self._lower = np.empty((grid.n_y, 4, body.modes))
        kernels.factorise(
            material.p_wave_modulus * body.x_stiffness + density * body.x_mass,
            material.shear_modulus * body.x_mass,
            material.shear_modulus * body.x_stiffness + density * body.x_mass,
            material.p_wave_modulus * body.x_mass,
            body.sine,
            body.mass,
            body.stiffness,
            body.derivative,
            material.lame_modulus,
            material.coupling_modulus,
            HELD[body.far_side],
            self.pivot,
            self._inverse,
            self._lower,
        )
        self.modal = self.pivot[:2]  # the first row, as u_y is zero

    @property
    def megabytes(self) -> float:
        """Memory that the operator holds once all of its parts are in use (MB)."""
        grid = self.body.grid
        levels = grid.n_y + 1
        return 8e-6 * levels * (9 * grid.n_x + 2 * levels)

    def swept_down(
        self,
        load: Field,
        edge: Array,
        modes: Array | None = None,
    ) -> Array:
        """Sweep a load (N/m) down to the interface, with given edge values (m).

        Parameters
        ----------
        load, edge
            As in :meth:`Elimination.swept_down`.
        modes : ndarray, optional
            Array for the result.
        """
        if modes is None:
            modes = np.empty_like(load.modes)
        kernels.eliminate(
            self._lower,
            load.modes,
            self._profiles(edge),
            self.body.edge_weights,
            self.body.mode_scale,
            modes,
        )
        return modes

    def _profiles(self, edge: Array) -> Array:
        """Profiles along y of the forces that edge values exert on the modes; here none."""
        return np.zeros((3, edge.size))

    def reduced(self, swept: Array) -> tuple[Array, None]:
        """Return the load in level 0; on a rigid base it does not move the interface."""
        return swept[0].copy(), None

    def substitute_up(
        self,
        swept: Array,
        amplitudes: Array,
        start: Array | None,
    ) -> None:
        """Sweep back from the interface in place.

        Parameters
        ----------
        swept, amplitudes, start
            As in :meth:`Elimination.substitute_up`.
        """
        swept[0, 0] = amplitudes
        swept[0, 1] = 0.0
        self.substitute(swept)

    def substitute(self, modes: Array) -> None:
        """Sweep back from the interface, where the displacement is known, in place.

        Parameters
        ----------
        modes : ndarray
            The swept load, with the displacement in level 0; at least the two lowest levels.
        """
        levels = len(modes)
        kernels.substitute(
            self._inverse[:levels],
            self._lower[: levels - 1],
            modes,
        )
