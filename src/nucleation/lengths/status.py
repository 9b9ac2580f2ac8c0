"""Nucleation lengths of faults with their status: the reason for each NaN."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from ..theory.arrays import fault_of
from ..theory.creep.lengths import stability_answers
from ..theory.critical import stability_reason
from ..theory.crossings import largest_crossings
from ..theory.fault import FaultParameters, Values, labelled, takes_fault
from ..theory.spectrum import Systems
from ..theory.status import STABLE, UNKNOWN, VALUE
from ..theory.values import Numbers
from .in_use import LENGTHS, values_of, with_dimensions
from .length import THIS_FAULT, Length, number

if TYPE_CHECKING:
    import xarray as xr

TITLES = {"critical_length": "critical length L_c", "stability_length": "stability length L_s"}
"""The lengths of the theory, listed before those of the literature."""

LITERATURE = tuple(length for length in LENGTHS if length.system != THIS_FAULT)

TITLES_OF_ALL = TITLES | {length.key: length.title for length in LITERATURE}
"""The title of every length, by key."""


Texts: TypeAlias = "NDArray[np.object_] | xr.DataArray"


class Answers(NamedTuple):
    """A length of one or many faults, with its status; arrays or DataArrays of equal shape."""

    length: Numbers
    """In metres, NaN where there is none."""
    status: Texts
    """``value``, ``stable``, ``beyond`` or ``unknown``."""
    reason: Texts
    """Why there is no value; empty where there is one."""


@takes_fault
def length_statuses(
    *,
    weakening_rate: Values | None = None,
    **fault: Values,
) -> xr.Dataset:
    """All nucleation lengths of a fault, and the reason for each NaN.

    Parameters
    ----------
    weakening_rate : array_like, optional
        Slip weakening W (Pa/m) of Uenishi and Rice's length.
    **fault
        The parameters of :class:`~nucleation.api.fault.Fault`.

    Returns
    -------
    Dataset
        ``length`` (m), ``status`` and ``reason`` over ``key`` and the dimensions of the fault. The
        keys are ``critical_length``, ``stability_length`` and those of
        :func:`~nucleation.lengths.in_use.lengths_in_use`. The status is ``value``; ``stable`` where
        no patch nucleates, however long; ``beyond`` where the length exceeds the range of the
        search, which the reason states; or ``unknown`` where a theory or formula is not applicable.

    Raises
    ------
    ParameterError
        If a parameter is missing, unknown or outside its range.

    Examples
    --------
    >>> fault = {"shear_modulus": 30e9, "poisson_ratio": 0.25, "normal_stress": 50e6}
    >>> found = length_statuses(**fault, a=0.015, b=0.010, slip_distance=5e-6)
    >>> str(found["status"].sel(key="critical_length").values)
    'stable'
    """
    import xarray as xr

    answers = answers_of(fault_of(fault), weakening_rate)
    found: dict[str, xr.DataArray] = {}
    for position, name in enumerate(Answers._fields):
        arrays = with_dimensions({key: answer[position] for key, answer in answers.items()})
        alike = xr.broadcast(*arrays.values())
        index = xr.IndexVariable("key", list(arrays))
        parts = [x.drop_attrs() for x in alike]
        found[name] = xr.concat(parts, index).rename(name)
    found["length"] = found["length"].assign_attrs(units="m", long_name="length")
    titles = [TITLES_OF_ALL[key] for key in answers]
    return xr.Dataset(found).assign_coords(title=("key", titles))


def answers_of(
    fault: FaultParameters,
    weakening_rate: Values | None = None,
) -> dict[str, Answers]:
    """L_c, L_s and the lengths of the literature, each with its status.

    Parameters
    ----------
    fault : FaultParameters
        One fault, or arrays of faults.
    weakening_rate : array_like, optional
        Slip weakening W (Pa/m) of Uenishi and Rice's length.

    Returns
    -------
    dict
        :class:`Answers` by key, as in :func:`length_statuses`.
    """
    theory = answers_of_theory(fault)
    found = {f"{criterion}_length": answer for criterion, answer in theory.items()}
    values = values_of(fault, weakening_rate, LITERATURE)
    for one in LITERATURE:
        found[one.key] = _literature_answers(one, values[one.key], fault)
    return found


def answers_of_theory(fault: FaultParameters) -> dict[str, Answers]:
    """The lengths of the theory, each with its status.

    Parameters
    ----------
    fault : FaultParameters
        One fault, or arrays of faults.

    Returns
    -------
    dict
        L_c by the key ``critical``, L_s by ``stability``.
    """
    length, _, _, status, reason = stability_answers(fault)
    return {
        "critical": _critical_answers(fault),
        "stability": Answers(length, status, reason),
    }


def _critical_answers(fault: FaultParameters) -> Answers:
    """L_c with its status."""

    def points(systems: Systems) -> NDArray[np.object_]:
        lengths = 2.0 * np.pi / largest_crossings(systems)
        found = np.full((3, systems.a.size), "", dtype=object)
        found[0] = lengths
        found[1] = VALUE
        for i in np.flatnonzero(np.isnan(lengths)):
            found[1, i] = STABLE
            found[2, i] = stability_reason(systems.at(np.array([i])))
        return found

    rows = fault.evaluate(points, rows=3, dtype=object)
    lengths = rows[:1].astype(float)[0]
    return Answers(lengths, rows[1], rows[2])


def _literature_answers(
    one: Length,
    length: Numbers,
    fault: FaultParameters,
) -> Answers:
    """A length of the literature with its status.

    A NaN means that the fault is stable if friction does not weaken with slip rate, and else that
    the formula is not applicable.
    """
    facts = one.facts(fault)
    names = list(facts)

    def reason_of(value: float, *numbers: float) -> str:
        if np.isfinite(value):
            return ""
        known = []
        for name, fact in zip(names, numbers, strict=True):
            unit = " m" if name == "H" else ""
            known.append(f"{name} = {fact:.4g}{unit}")
        return f"needs {one.needs}: {', '.join(known)}"

    def status_of(
        value: float,
        zeta: float,
    ) -> str:
        if np.isfinite(value):
            return VALUE
        return STABLE if zeta <= 0.0 else UNKNOWN

    reason = _elementwise(reason_of, length, *facts.values())
    status = _elementwise(status_of, length, number(fault, "zeta"))
    return Answers(length, status, reason)


def _elementwise(function: Callable[..., str], *arrays: Numbers) -> Texts:
    """The texts that a function of numbers returns at every point of arrays or DataArrays."""
    at_each: Callable[..., Texts] = np.vectorize(function, otypes=[object])
    if not any(map(labelled, arrays)):
        return at_each(*arrays)
    import xarray as xr

    texts: Texts = xr.apply_ufunc(at_each, *arrays)
    return texts
