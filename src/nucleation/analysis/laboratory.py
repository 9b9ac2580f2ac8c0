"""Published laboratory faults: what was read of them, and lengths where that suffices.

The numbers are in ``laboratory.yaml``, each with whether it was measured or assumed and where it
was read. What nobody has read is unknown: no length is computed from it.
"""

import dataclasses
import math
from importlib.resources import files as resources
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
import yaml

from ..answers.specimen import SPECIMEN
from ..datasets.shared import SHARED
from ..datasets.variables import Variable, some, table
from ..model.material import PLANES
from ..model.quantities import ParameterError, Quantity
from ..model.units import parse
from ..theory.arrays import critical_length
from ..theory.creep.lengths import stability_length
from ..theory.fault import QUANTITIES
from .lengths import COLUMNS as LENGTHS

READ = ("measured", "assumed")
NEEDED = ("shear_modulus", "poisson_ratio", "normal_stress", "a", "b", "slip_distance")
"""What a length needs; without a height the bodies are half-spaces."""

_OWN = ("normal_stress", "friction", "a", "b", "slip_distance", "velocity", "height")
ENTRIES = {
    **{name: QUANTITIES[name] for name in ("shear_modulus", "poisson_ratio", *_OWN)},
    "young_modulus": dataclasses.replace(
        QUANTITIES["shear_modulus"], description="Young's modulus", symbol="E"
    ),
    "density": Quantity("mass density", unit="kg/m^3", low=0.0, high=1e6),
    "fault_length": SPECIMEN,
    "thickness": dataclasses.replace(SPECIMEN, description="thickness of the bodies along z"),
    "loading_rate": Quantity("rate of the shear stress", unit="Pa/s", low=0.0, high=1e15),
    "observed_length": dataclasses.replace(
        SPECIMEN, description="nucleation length that was observed"
    ),
}
"""What a number may be, with unit and range."""

WORDS = ("title", "material", "source", "read", "says")

COLUMNS = {
    "laboratory_fault": Variable("", "name of the laboratory fault"),
    "title": Variable("", "authors and year"),
    "fault_length": Variable("m", "length of the fault"),
    "lowest_stress": Variable("Pa", "lowest compressive normal stress", "sigma0"),
    "observed_low": Variable("m", "shortest nucleation length that was observed"),
    "observed_high": Variable("m", "longest nucleation length that was observed"),
    **some(LENGTHS, "creep_length", "theory_length"),
    "plane": SHARED["plane"],
    "assumed": Variable("", "numbers of the theory's lengths that were assumed"),
    "unknown": Variable("", "numbers that they need and nobody has read"),
}


class Number(NamedTuple):
    """A number of an experiment in SI units; NaN where it is unknown."""

    low: float  # the ends of its range, equal for a single number
    high: float
    status: str  # measured, assumed or unknown
    where: str  # it was read


UNKNOWN = Number(math.nan, math.nan, "unknown", "not read")


@dataclasses.dataclass(frozen=True)
class LaboratoryFault:
    """A published laboratory fault: what it is, and who published it."""

    name: str
    title: str
    material: str
    source: str
    read: str  # how much of the source was read
    says: str  # what the source says of nucleation, in our words
    plane: str  # strain or stress
    numbers: dict[str, Number]  # by the names of ENTRIES, all of them

    @property
    def unknown(self) -> tuple[str, ...]:
        """What a length needs of :data:`NEEDED` and is not known as one number."""
        return tuple(n for n in NEEDED if self.numbers[n].low != self.numbers[n].high)

    @property
    def assumed(self) -> tuple[str, ...]:
        """What a length needs and was assumed, by the source or by this project."""
        return tuple(n for n in (*NEEDED, "height") if self.numbers[n].status == "assumed")

    @property
    def parameters(self) -> dict[str, Any] | None:
        """The parameters of :class:`~nucleation.theory.fault.Fault`, None if some are unknown."""
        if self.unknown:
            return None
        values = {name: self.numbers[name].low for name in NEEDED}
        if math.isfinite(height := self.numbers["height"].low):
            values["height"] = height
        return values | {"plane": self.plane}


def laboratory_faults() -> tuple[LaboratoryFault, ...]:
    """All published laboratory faults of which something was read.

    Raises
    ------
    ParameterError
        If an entry of the file is none: naming fault, key, value, unit and range.
    """
    text = resources(__package__).joinpath("laboratory.yaml").read_text(encoding="utf-8")
    return tuple(read_fault(name, entry) for name, entry in yaml.safe_load(text).items())


def read_fault(name: str, entry: dict[str, Any]) -> LaboratoryFault:
    """One fault as it stands in the file; raises ParameterError for what is no entry."""
    missing = {*WORDS} - entry.keys() - {"says"}
    extra = entry.keys() - {*WORDS, "plane", *READ}
    if missing or extra:
        raise ParameterError(
            f"{name}: lacks {sorted(missing)}, has {sorted(extra)} which is no key"
        )
    plane = entry.get("plane", "strain")
    if plane not in PLANES:
        raise ParameterError(f"{name}.plane = {plane!r} is not allowed: one of {', '.join(PLANES)}")
    numbers = dict.fromkeys(ENTRIES, UNKNOWN)
    for status in READ:
        for where, values in entry.get(status, {}).items():
            if not isinstance(values, dict):
                raise ParameterError(f"{name}.{status} is not allowed: numbers stand below where "
                                     "they were read")  # fmt: skip
            numbers |= {key: _number(name, key, values[key], status, where) for key in values}
    young, ratio = numbers["young_modulus"], numbers["poisson_ratio"]
    if numbers["shear_modulus"] is UNKNOWN and math.isfinite(young.low + ratio.low):
        status = max(young.status, ratio.status, key=READ.index)
        low, high = (e / (2.0 * (1.0 + ratio.low)) for e in (young.low, young.high))
        numbers["shear_modulus"] = Number(low, high, status, "E/[2 (1 + nu)]")
    words = {word: entry.get(word, "") for word in WORDS}
    return LaboratoryFault(name=name, plane=plane, numbers=numbers, **words)


def _number(fault: str, key: str, value: Any, status: str, where: str) -> Number:
    """One number of an entry, checked."""
    if key not in ENTRIES:
        raise ParameterError(f"{fault}.{key} is not allowed: known are {', '.join(ENTRIES)}")
    ends = value if isinstance(value, list) else [value] * 2
    low, high = (float(parse(f"{fault}.{key}", str(end), ENTRIES[key])) for end in ends)
    return Number(low, high, status, where)


def laboratory_table(faults: dict[str, dict[str, Any]]) -> xr.Dataset:
    """:data:`COLUMNS` of a file's entries: lengths observed, and computed where all is known."""
    rows = []
    for own in map(read_fault, faults, faults.values()):
        parameters, numbers = own.parameters, own.numbers
        rows.append({
            "laboratory_fault": own.name,
            "title": own.title,
            "fault_length": numbers["fault_length"].low,
            "lowest_stress": numbers["normal_stress"].low,
            "observed_low": numbers["observed_length"].low,
            "observed_high": numbers["observed_length"].high,
            "creep_length": float(stability_length(**parameters)) if parameters else np.nan,
            "theory_length": float(critical_length(**parameters)) if parameters else np.nan,
            "plane": own.plane,
            "assumed": " ".join(own.assumed if parameters else ()),
            "unknown": " ".join(own.unknown),
        })  # fmt: skip
    return table(rows, COLUMNS)
