"""The lengths of a fault, each with value, range, status, reason and doubt."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ..model.hints import warn_of_implausible
from ..model.quantities import declared
from ..theory.creep.lengths import stability_answers
from ..theory.critical import at_each, stability_reason
from ..theory.evaluation import evaluate
from ..theory.spectrum import Systems
from ..theory.status import STABLE, UNKNOWN, VALUE, NoLength
from ..theory.values import FaultLike, Numbers, Values, labelled
from ..types import Array
from .formulas import TWO_MATERIALS, Length
from .in_use import LENGTHS, values_of

if TYPE_CHECKING:
    import xarray as xr

TITLES = {
    "critical_length": "critical length L_c",
    "stability_length": "stability length L_s",
    "runaway_length": "runaway length L_run",
    "drop_length": "length at the drop L",
    "process_zone": "process zone",
}
TITLES |= {length.key: length.title for length in LENGTHS}
"""Title of each length by key: those of the theory, and of the literature."""

_HALVINGS = 60  # of the interval of log k in which the process zone is searched
_SPAN = 1e6  # ratio of the longest one of the search to L_b/2, and of that to the shortest

_CRITICAL = declared("critical length", "(0, inf) m")
_KNOWN = {length.key: length for length in LENGTHS}


class Answer(NamedTuple):
    """A length of one or many faults; numbers, arrays or DataArrays of equal shape."""

    value: Any
    """In metres, NaN where there is none."""
    low: Any
    """Lower end of its range (m)."""
    high: Any
    """Upper end of its range (m)."""
    status: Any
    """``value``; else ``stable``, ``beyond`` or ``unknown``."""
    reason: Any
    """Why there is no value; empty where there is one."""
    doubt: Any = ""
    """Why the value is uncertain beyond its range; empty if it is not."""

    @property
    def exists(self) -> bool:
        """Whether a single fault has the length."""
        return bool(np.isfinite(self.value))


class Lengths(dict[str, Answer]):
    """The lengths of a fault: :class:`Answer` by key, as a table where it is printed.

    Examples
    --------
    >>> from nucleation.api import PAPER
    >>> found = PAPER.lengths()
    >>> round(float(found["critical_length"].value), 3), found["drop_length"].status
    (0.238, 'value')
    """

    def dataset(self) -> xr.Dataset:
        """The table as a Dataset over ``length`` and the dimensions of the fault.

        Returns
        -------
        Dataset
            ``value``, ``low``, ``high`` (m), ``status``, ``reason`` and ``doubt``. Arrays without
            named dimensions have the dimensions ``axis_0``, ``axis_1``, ...
        """
        import xarray as xr

        found = {}
        for field in Answer._fields:
            columns = {key: getattr(answer, field) for key, answer in self.items()}
            plain = {key: array for key, array in columns.items() if not labelled(array)}
            shape = np.broadcast_shapes(*map(np.shape, plain.values()))
            dims = [f"axis_{n}" for n in range(len(shape))]
            for key, array in plain.items():
                columns[key] = xr.DataArray(np.broadcast_to(array, shape), dims=dims)
            alike = xr.broadcast(*columns.values())
            index = xr.IndexVariable("length", list(self))
            parts = [x.drop_attrs() for x in alike]
            found[field] = xr.concat(parts, index).rename(field)
        for field in ("value", "low", "high"):
            found[field] = found[field].assign_attrs(units="m")
        titles = [TITLES[key] for key in self]
        return xr.Dataset(found).assign_coords(title=("length", titles))

    def __repr__(self) -> str:
        if any(np.size(answer.value) != 1 for answer in self.values()):
            return repr(self.dataset())
        rows = []
        for key, answer in self.items():
            shown = [TITLES[key], "", "", ""]
            if answer.exists:
                shown[1] = f"{answer.value:.4g} m"
                if answer.high > answer.low * 1.0001:
                    shown[2] = f"{answer.low:.4g} to {answer.high:.4g} m"
                shown[3] = str(answer.doubt)
            else:
                shown[3] = f"{answer.status}: {answer.reason}"
            rows.append(shown)
        widths = [max(map(len, column)) for column in zip(*rows, strict=True)][:-1]
        lines = []
        for *cells, last in rows:
            padded = map(str.ljust, cells, widths)
            lines.append("  ".join([*padded, last]).rstrip())
        return "\n".join(lines)


def answers_of_theory(fault: FaultLike) -> dict[str, Answer]:
    """L_c and L_s."""

    def point(one: Systems, critical: float) -> tuple[float, str, str]:
        if np.isnan(critical):
            raise NoLength(stability_reason(one), STABLE)
        return critical, VALUE, ""

    rows = at_each(fault, point, rows=3)
    longest = rows[:1].astype(float)[0]
    warn_of_implausible("critical_length", longest, _CRITICAL)
    critical = Answer(longest, longest, longest, rows[1], rows[2])
    length, error, status, reason = stability_answers(fault)
    low, high = length * (1.0 - error), length * (1.0 + error)
    stability = Answer(length, low, high, status, reason)
    return {"critical_length": critical, "stability_length": stability}


def process_zone(fault: FaultLike) -> Any:
    """The process zone (m) of each fault, NaN where b is not positive.

    The wavelength over 2 pi at which the stiffness of the bodies is ``b sigma0/D``: ``L_b/2``
    between identical half-spaces, ``sqrt(2 H L_b)`` in a thin layer on a rigid body, with
    ``L_b = mu* D/(b sigma0)``. That of half-spaces is customarily ``(9 pi/32) L_b`` (Lapusta and
    Liu, 2009), which is larger.
    """

    def zones(systems: Systems) -> Array:
        b = np.where(systems.b > 0.0, systems.b, np.nan)
        thick = systems.softness / b
        low = 1.0 / (_SPAN * thick)
        high = _SPAN / thick
        for _ in range(_HALVINGS):
            middle = np.sqrt(low * high)
            stiff = systems.load_and_coupling(middle)[0] > b
            low = np.where(stiff, low, middle)
            high = np.where(stiff, middle, high)
        return 1.0 / low[None]

    return evaluate(fault, zones)[0]


def answers_of_literature(
    fault: FaultLike, weakening_rate: Values | None = None
) -> dict[str, Answer]:
    """The process zone and the lengths of the literature, with W (Pa/m) of Uenishi and Rice's."""
    second = fault.second_shear_modulus
    differ = (second != fault.shear_modulus) | (fault.second_poisson_ratio != fault.poisson_ratio)
    of_two = bool(np.any(np.isfinite(second) & differ))
    used = [one for one in LENGTHS if of_two or one.system != TWO_MATERIALS]
    values = values_of(fault, weakening_rate, used)
    found = {one.key: _answer(one, values[one.key], fault) for one in used}
    # which needs b > 0 as well
    zone = _answer(_KNOWN["state_evolution"], process_zone(fault), fault)
    return {"process_zone": zone} | found


def _answer(one: Length, length: Numbers, fault: FaultLike) -> Answer:
    """A length of the literature; NaN means a stable fault if zeta <= 0, else another range."""
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

    def status_of(value: float, zeta: float) -> str:
        if np.isfinite(value):
            return VALUE
        return STABLE if zeta <= 0.0 else UNKNOWN

    reason = _elementwise(reason_of, length, *facts.values())
    status = _elementwise(status_of, length, fault.zeta)
    if not labelled(status):
        alike = np.broadcast_arrays(length, status, reason)
        length, status, reason = (x[()] for x in alike)
    return Answer(length, length, length, status, reason)


def _elementwise(function: Callable[..., str], *arrays: Numbers) -> Any:
    """The texts that a function of numbers returns at every point of arrays or DataArrays."""
    at_each = np.vectorize(function, otypes=[object])
    if not any(map(labelled, arrays)):
        return at_each(*arrays)[()]
    import xarray as xr

    return xr.apply_ufunc(at_each, *arrays)
