"""Whether a fault has a length, and why not: the status that belongs to each NaN."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ..theory.arrays import fault_of
from ..theory.creep.lengths import stability_answers
from ..theory.critical import stability_reason
from ..theory.crossings import largest_crossings
from ..theory.fault import Fault, Values, labelled, takes_fault
from ..theory.spectrum import Systems
from ..theory.status import STABLE, UNKNOWN, VALUE
from .in_use import LENGTHS, THIS_FAULT, Length, values_of, with_dimensions

if TYPE_CHECKING:
    import xarray as xr

TITLES = {"critical_length": "critical length L_c", "stability_length": "stability length L_s"}
"""The lengths of the theory, which come before those of the literature."""

LITERATURE = tuple(length for length in LENGTHS if length.system != THIS_FAULT)


class Answers(NamedTuple):
    """A length of one or many faults, with its status; arrays or DataArrays of equal shape."""

    length: Any  # m, NaN where there is none
    status: Any  # text: "value", "stable", "beyond" or "unknown"
    reason: Any  # text, empty where there is a value


@takes_fault
def length_statuses(
    *, weakening_rate: Values | None = None, loading: str = "edge", **fault: Values
) -> xr.Dataset:
    """All nucleation lengths of a fault, and why there is none where one is NaN.

    Parameters
    ----------
    weakening_rate : array_like, optional
        Slip weakening W (Pa/m) of Uenishi and Rice's length.
    loading : {"edge", "top", "remote"}
        Where the creeping patch of L_s begins.
    **fault
        The parameters of :class:`~nucleation.theory.fault.Fault`.

    Returns
    -------
    Dataset
        ``length`` (m), ``status`` and ``reason`` over ``key``, which has ``critical_length``,
        ``stability_length`` and the keys of :func:`~nucleation.answers.in_use.lengths_in_use`, and
        over the dimensions of the fault. The status is ``value``; ``stable`` where no patch of any
        length nucleates; ``beyond`` where the length is longer than the longest that was searched,
        which the reason names; or ``unknown`` where a theory or formula does not apply.

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

    own = fault_of(fault)
    answers = answers_of(own, weakening_rate, loading)
    titles = TITLES | {length.key: length.title for length in LITERATURE}
    found: dict[str, Any] = {}
    for position, name in enumerate(Answers._fields):
        arrays = with_dimensions({key: answer[position] for key, answer in answers.items()})
        alike = xr.broadcast(*arrays.values())
        index = xr.IndexVariable("key", list(arrays))
        found[name] = xr.concat([x.drop_attrs() for x in alike], index).rename(name)
    found["length"] = found["length"].assign_attrs(units="m", long_name="length")
    return xr.Dataset(found).assign_coords(title=("key", [titles[key] for key in answers]))


def answers_of(
    fault: Fault, weakening_rate: Values | None = None, loading: str = "edge"
) -> dict[str, Answers]:
    """L_c, L_s and the lengths of the literature by key, each with its status."""
    theory = answers_of_theory(fault, loading)
    found = {f"{criterion}_length": answer for criterion, answer in theory.items()}
    values = values_of(fault, weakening_rate, LITERATURE)
    for one in LITERATURE:
        found[one.key] = _literature_answers(one, values[one.key], fault)
    return found


def answers_of_theory(fault: Fault, loading: str = "edge") -> dict[str, Answers]:
    """L_c, by ``critical``, and L_s, by ``stability``, each with its status."""
    length, _, _, status, reason = stability_answers(fault, None, loading)
    return {"critical": critical_answers(fault), "stability": Answers(length, status, reason)}


def critical_answers(fault: Fault) -> Answers:
    """L_c with its status."""

    def points(systems: Systems) -> Any:
        found = np.full((3, systems.a.size), "", dtype=object)
        found[0] = 2.0 * np.pi / largest_crossings(systems)
        found[1] = VALUE
        for i in np.flatnonzero(np.isnan(found[0].astype(float))):
            found[1:, i] = STABLE, stability_reason(systems.at(np.array([i])))
        return found

    rows = fault.evaluate(points, rows=3, dtype=object)
    return Answers(rows[:1].astype(float)[0], rows[1], rows[2])


def _literature_answers(one: Length, length: Any, fault: Fault) -> Answers:
    """A length of the literature with its status.

    Where friction does not weaken with slip rate, no patch nucleates by a formula without a value.
    """
    facts = one.facts(fault)
    names = list(facts)

    def text_of(value: float, *numbers: float) -> str:
        if np.isfinite(value):
            return ""
        pairs = zip(names, numbers, strict=True)
        known = ", ".join(f"{k} = {x:.4g}{' m' if k == 'H' else ''}" for k, x in pairs)
        return f"needs {one.needs}: {known}"

    def status_of(value: float, zeta: float) -> str:
        if np.isfinite(value):
            return VALUE
        return STABLE if zeta <= 0.0 else UNKNOWN

    reason = _elementwise(text_of, length, *facts.values())
    return Answers(length, _elementwise(status_of, length, fault.zeta), reason)


def _elementwise(function: Any, *arrays: Any) -> Any:
    """A function of numbers that gives a text, at every point of arrays or DataArrays."""
    at_each = np.vectorize(function, otypes=[object])
    if not any(map(labelled, arrays)):
        return at_each(*arrays)
    import xarray as xr

    return xr.apply_ufunc(at_each, *arrays)
