"""The stability length L_s: the shortest creeping patch with a growing mode.

The eigenproblem of :mod:`.linearised` is solved at lengths that rise by a constant factor until a
mode grows, from below the shortest that any fault is known to have, and then between the last two.

All modes count, oscillating or not. A growth rate that is real cannot cross zero: its mode would
keep the balance of forces at rest, ``(K1 + f S2) dw = 0``, and a patch of any length resists slip.
So growth begins with a pair of complex rates. Where ``a << zeta`` that pair oscillates in a narrow
window of lengths only and then grows without oscillation: a search for oscillating modes steps over
the window and finds nothing, or a longer patch.
"""

from __future__ import annotations

import dataclasses
import math
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

from ...model.friction.constants import full_law
from ...model.friction.law import Friction
from ...model.linearised import interface_state
from ...model.loading import LOADINGS
from ...model.parameters import Parameters
from ...model.quantities import ParameterError
from ...types import Array
from ..arrays import fault_of, named
from ..critical import systems_of
from ..crossings import largest_crossings
from ..estimates import loading_rate
from ..fault import Fault, Values, takes_fault
from ..spectrum import Systems
from ..status import BEYOND, STABLE, UNKNOWN, VALUE
from ..transfer import bodies_of
from .linearised import FrozenPatch, constant_coefficients, creeping_patch, local_coefficients
from .modes import Creep, creep, extrapolation_error, modes_for, response

LONGEST = 3.0  # patches up to this multiple of L_c are tried
SHORTEST, FACTOR = 0.7, 1.12  # where the search starts, over its guess; from length to length
PRECISION = 1e-9  # relative, of L_s for a given number of modes
STEP = 1e-3  # of log L, in the derivative of the growth rate


class NoPatch(ValueError):
    """No patch of the lengths looked at turns unstable, or none keeps contact.

    Parameters
    ----------
    reason : str
        Why, in words.
    status : {"stable", "beyond", "unknown"}
        Which kind of reason it is: see :mod:`nucleation.theory.status`.
    """

    def __init__(self, reason: str, status: str = UNKNOWN):
        super().__init__(reason)
        self.status = status


class StabilityPoint(NamedTuple):
    """Where the creeping patch turns unstable; V is the slip rate of its fastest place."""

    length: float  # L_s (m)
    frequency: float  # angular frequency of its mode there, over V/D
    growth: float  # d Re Lambda/d log L, over V/D
    error: float  # relative, of the length: by three quarters of the modes, and of slim layers


@dataclasses.dataclass(frozen=True)
class Patches:
    """The creeping patches of one fault, of any length.

    A patch begins at an ``edge`` that is pushed, at a side that is free under a moved ``top``, or
    in between under a ``remote`` load. Without an edge `load_rate` is the rise of the shear stress
    that loads it, over ``sigma0 V/D``; with constant a and b nothing depends on that.
    """

    one: Systems  # a single fault, all fields of shape (1,)
    law: Friction | None = None  # with whose local a(v) and b(v); without it they are constant
    velocity: float = 1.0  # V (m/s), which a law needs
    loading: str = "edge"
    load_rate: float = 1.0

    @classmethod
    def of(cls, parameters: Parameters) -> Patches:
        """Those of a run, with its own friction law.

        Without an edge that is pushed a patch begins where the declared heterogeneity is: at a free
        side where that is nearer than the block is high, else in the interior, as friction has no
        shear stress to bear at the side itself.
        """
        one = systems_of([(*bodies_of(parameters), interface_state(parameters))])
        loading, block = parameters.loading, parameters.geometry
        own = cls(one, parameters.friction, loading.velocity)
        if loading.kind == "edge":
            return own
        centre = parameters.heterogeneity.centre
        away = 0.5 * block.length if centre is None else min(centre, block.length - centre)
        begins = "top" if loading.kind == "top" and away < block.height else "remote"
        rate = loading_rate(parameters) * parameters.memory_time / loading.normal_stress
        return dataclasses.replace(own, loading=begins, load_rate=rate)

    @cached_property
    def number(self) -> int:
        """Of modes that the fault needs."""
        return modes_for(self.one)

    def creep(self, length: float, number: int | None = None) -> Creep:
        """How a patch of a length (m) creeps."""
        held = response(self.one, length, number or self.number, self.loading)
        load_rate = None if self.loading == "edge" else self.load_rate
        return creep(held, float(self.one.friction[0]), load_rate)

    def at(self, length: float, number: int | None = None) -> FrozenPatch:
        """The linearised patch of a length (m); slip in D, time in D/V.

        Raises
        ------
        NoPatch
            If the creep takes all of the compression somewhere.
        """
        creep, one = self.creep(length, number), self.one
        if creep.normal_stress.min() <= 0.0:
            raise NoPatch(f"the creep opens the fault at a patch length of {length:.4g} m")
        if self.law is not None:
            friction = local_coefficients(self.law, self.velocity * creep.fastest, creep.slip_rate)
        else:
            values = (float(x[0]) for x in (one.friction, one.a, one.zeta))
            friction = constant_coefficients(creep.slip_rate, *values)
        return creeping_patch(creep, friction)

    def growth(self, length: float, number: int | None = None) -> float:
        """Re Lambda over V/D of the fastest growing mode, oscillating or not."""
        return float(self.at(length, number).eigenvalues[0].real)

    def rate_near(self, length: float, rate: complex, number: int | None = None) -> complex:
        """Lambda over V/D of the mode whose rate is nearest to another."""
        rates = self.at(length, number).eigenvalues
        return complex(rates[np.abs(rates - rate).argmin()])


def stability_point(patches: Patches, critical: float) -> StabilityPoint:
    """L_s of one fault whose L_c (m) is `critical`, NaN where homogeneous sliding is stable.

    Raises
    ------
    NoPatch
        If homogeneous sliding is stable, no patch up to ``LONGEST L_c`` has a growing mode, or its
        creep opens the fault.
    """
    if not math.isfinite(critical):
        raise NoPatch("homogeneous sliding is stable", STABLE)

    def growth(log_length: float) -> float:
        return patches.growth(math.exp(log_length))

    low, step = math.log(SHORTEST * _guess(patches.one) * critical), math.log(FACTOR)
    while growth(low) > 0.0:
        low -= 2.0 * step
    high, longest = low + step, math.log(LONGEST * critical)
    while growth(high) <= 0.0:
        low, high = high, high + step
        if low > longest:
            raise NoPatch(
                f"no patch up to {LONGEST:g} L_c = {LONGEST * critical:.4g} m has a growing mode",
                BEYOND,
            )
    return _point(patches, brentq(growth, low, high, xtol=PRECISION))


def _point(patches: Patches, log_length: float) -> StabilityPoint:
    """What is known of the pair of modes whose growth begins at a length."""
    length = math.exp(log_length)
    rates = patches.at(length).eigenvalues
    pairs = rates[rates.imag > 0.0]
    rate = complex((pairs if pairs.size else rates)[0])
    before, after = (patches.rate_near(length * math.exp(d), rate).real for d in (-STEP, STEP))
    slope = (after - before) / (2.0 * STEP)
    with_fewer_modes = patches.rate_near(length, rate, 3 * patches.number // 4).real
    error = abs(with_fewer_modes - rate.real) / slope + PRECISION
    error += extrapolation_error(patches.one, length)
    return StabilityPoint(length, rate.imag, slope, error)


def _guess(one: Systems) -> float:
    """About L_s over L_c: that of a thin layer (:mod:`.thin`), or of one that does not weaken."""
    zeta = max(float(one.zeta[0]), 1e-6)
    return min(0.5 * (1.0 + 0.25 * float(one.a[0]) / zeta), 1.0)


@takes_fault
def stability_length(
    *, friction_law: Friction | None = None, loading: str = "edge", **fault: Values
) -> Any:
    """Stability length L_s: where a creeping patch turns unstable.

    Parameters
    ----------
    friction_law : Friction, optional
        The full law, of which each fault has its own with the fault's f, a, zeta and D, and local
        a(v), b(v) along the patch; needs `velocity`. By default a and b are constant.
    loading : {"edge", "top", "remote"}
        Where the patch begins: at an edge that is pushed, at a side that is free under a top that
        moves, or in the interior under whatever loads it from afar, a top that moves among it.
        That is said by the bodies' `far_side`: a top that moves has ``velocity``.
    **fault
        The parameters of :class:`~nucleation.theory.fault.Fault`.

    Returns
    -------
    ndarray or DataArray
        L_s (m), broadcast shape; NaN, for a reason that ``nucleation.api.length_statuses`` has,
        where homogeneous sliding is stable, where no patch up to
        ``3 L_c`` has a growing mode, and where its creep would open the fault. A
        DataArray if there is one among the parameters, else a pint quantity if there is one.

    Raises
    ------
    ParameterError
        If a parameter is missing, unknown or outside its range, no law has a fault's constants, or
        there is one without an edge: a slip rate on which its a(v) and b(v) depend is not V then.
    """
    own = fault_of(fault)
    length = stability_values(own, friction_law, loading)[0]
    return named(length, "stability_length", "m", "stability length of the creeping patch", own)


def stability_values(
    fault: Fault, friction_law: Friction | None = None, loading: str = "edge"
) -> tuple[Any, Any, Any]:
    """L_s (m), the mode's frequency over V/D and the relative error of L_s; plain, in SI units."""
    return stability_answers(fault, friction_law, loading)[:3]


def stability_answers(
    fault: Fault, friction_law: Friction | None = None, loading: str = "edge"
) -> tuple[Any, Any, Any, Any, Any]:
    """The same three, and the status of L_s with its reason, which is empty where there is L_s.

    Parameters
    ----------
    fault : Fault
        One or many faults.
    friction_law : Friction, optional
        The full law, as for :func:`stability_length`.
    loading : {"edge", "top", "remote"}
        Where the patch begins.

    Returns
    -------
    length, frequency, error, status, reason : ndarray or DataArray
        In SI units, broadcast shape; the last two are of texts.

    Raises
    ------
    ParameterError
        If the loading is unknown, or the law is not allowed with it or lacks a constant.
    """
    if loading not in LOADINGS:
        raise ParameterError(f"loading = {loading!r} is not allowed: one of {', '.join(LOADINGS)}")
    if friction_law is not None and loading != "edge":
        raise ParameterError(
            f"a friction law is not allowed with loading = {loading}, whose slip rate is not V: a "
            "and b are constant there"
        )
    if friction_law is not None and (fault.velocity is None or fault.friction is None):
        raise ParameterError("a friction law needs the fault's velocity and friction")

    def points(systems: Systems, velocity: Array) -> NDArray:
        critical = 2.0 * np.pi / largest_crossings(systems)
        found = np.full((5, critical.size), np.nan, dtype=object)
        for i, length in enumerate(critical):
            one = systems.at(np.array([i]))
            law = None if friction_law is None else _own_law(friction_law, one, velocity[i])
            try:
                point = stability_point(Patches(one, law, velocity[i], loading), float(length))
            except NoPatch as none:
                found[3:, i] = none.status, str(none)
                continue
            found[:, i] = point.length, point.frequency, point.error, VALUE, ""
        return found

    velocity = 1.0 if fault.velocity is None else fault.velocity
    rows = fault.evaluate(points, velocity, rows=5, dtype=object)
    length, frequency, error = rows[:3].astype(float)
    return length, frequency, error, rows[3], rows[4]


def stability_length_of(parameters: Parameters, critical: float, constant: bool = False) -> float:
    """L_s (m) of a run's fault whose L_c (m) is `critical`; NaN without one.

    With its own friction law, whose scales make a(v) and b(v) change along the patch, or with the
    `constant` a and b that it has at V.
    """
    patches = Patches.of(parameters)
    if constant:
        patches = dataclasses.replace(patches, law=None)
    try:
        return stability_point(patches, critical).length
    except NoPatch:
        return math.nan


def _own_law(law: Friction, one: Systems, velocity: float) -> Friction:
    """The law with the constants of a fault at V."""
    distance = float(velocity / one.rate[0])
    constants = (float(x[0]) for x in (one.friction, one.a, one.zeta))
    return full_law(
        law.changed({"characteristic_slip_distance": distance}), float(velocity), *constants
    )
