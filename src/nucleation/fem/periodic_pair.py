"""Two layers of one period on one another: homogeneous sliding of a pair and its modes.

Each layer has the modes of :mod:`.periodic`; they are put in series mode by mode (:mod:`.series`).
If no far side is held, the mean displacement of both layers together is free: in motion inertia
determines it; in statics, where the tractions on both far sides are in balance, it is zero.
"""

from __future__ import annotations

import dataclasses

import numpy as np

from ..types import Array
from .condensed import Balance, Expectation, Response
from .grid import Field
from .periodic import Circulant, PeriodicBlock, with_entry_zero
from .series import SeriesStiffness, TwoBodies


class PeriodicPair(TwoBodies[PeriodicBlock]):
    """A period of two layers, driven by shear tractions on their far sides."""

    def operator(self, s: float) -> _PeriodicPairOperator:
        """Factorise the dynamic stiffness ``K + s M`` (`s` in 1/s^2)."""
        return _PeriodicPairOperator(self, s)

    def top_load(self, normal_stress: float, shear_stress: float = 0.0) -> Field:
        """Return the nodal forces of stresses on the far sides.

        A component has no effect where the lower far side is held along its direction.

        Parameters
        ----------
        normal_stress : float
            Compressive stress (Pa).
        shear_stress : float
            Traction along x on the upper layer, opposite on the lower one (Pa).

        Returns
        -------
        Field
            The load (N/m).
        """
        above = self.upper.top_load(normal_stress, shear_stress)
        below = self.lower.top_load(normal_stress, -shear_stress)
        return self.joined(above, below)


@dataclasses.dataclass(frozen=True)
class _SweptResponse(Response):
    """A response with the swept load, and the interface's displacement at zero slip."""

    swept: Array
    start: Array


class _PeriodicPairOperator(Circulant):
    """``K + s M`` of a :class:`PeriodicPair`; D and N are circulant."""

    body: PeriodicPair

    def __init__(self, body: PeriodicPair, s: float) -> None:
        self.body = body
        self.s = s
        self.upper = body.upper.operator(s)
        self.lower = body.lower.operator(s)
        with np.errstate(invalid="ignore", divide="ignore"):
            self.series = SeriesStiffness(self.upper, self.lower)
        mass = body.upper.material.density + body.lower.material.density
        if body.lower.far_side == "free" and s * mass == 0.0:
            # the mean: both layers transmit the forces in balance, and do not move
            self.series.modal[:, 0] = 0.0
            self.series.compliance[:, 0] = 0.0
            self.series.forces[:, 0] = np.tile(0.5 * np.eye(2).ravel(), 2)
            self.series.by_slip[:, 0] = 0.5, 0.0
        self.along_x = body.upper
        self.modal = self.series.modal

    @property
    def megabytes(self) -> float:
        """Memory that the operator holds once all of its parts are in use (MB)."""
        return self.upper.megabytes + self.lower.megabytes

    def respond(self, load: Field, w: Array) -> _SweptResponse:
        """Find the forces that hold the interface.

        Parameters
        ----------
        load, w
            As in :meth:`.condensed.Operator.respond`.
        """
        modes = np.empty_like(load.modes)
        no_edge = np.zeros_like(load.edge)
        load_above, load_below = self.body.parts(load)
        above, below = self.body.parts(Field(modes, no_edge))
        self.upper.swept(load_above, above.edge, above.modes)
        self.lower.swept(load_below, below.edge, below.modes)
        held, start = self.series.loaded(above.modes[0], below.modes[0])
        amplitudes = self.along_x.sine_amplitudes(w)
        tangential, normal = self.interface_forces(amplitudes, held)
        return _SweptResponse(
            w,
            tangential,
            with_entry_zero(normal),
            load,
            modes,
            start,
        )

    def balance(
        self,
        response: Response,
        w: Array,
        expected: Expectation | None = None,
    ) -> Balance:
        """Find the displacement of both layers.

        Parameters
        ----------
        response, w, expected
            As in :meth:`.condensed.Operator.balance`.
        """
        assert isinstance(response, _SweptResponse)
        field = Field(response.swept, np.zeros_like(response.load.edge))
        above, below = self.body.parts(field)
        amplitudes = self.along_x.sine_amplitudes(w)
        self.series.set_interface(
            above.modes,
            below.modes,
            amplitudes,
            response.start,
        )
        self.upper.substitute(above.modes)
        self.lower.substitute(below.modes)
        return Balance(field, self.body.no_memory, True)
