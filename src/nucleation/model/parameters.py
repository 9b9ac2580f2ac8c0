"""All parameters of one simulation, as frozen and checked dataclasses in SI units."""

from __future__ import annotations

import dataclasses
import json
from functools import cache
from typing import Any, NamedTuple, get_type_hints

from .checked import Checked
from .friction.constants import CONSTANTS
from .friction.law import Friction
from .friction.registry import law_declarations
from .heterogeneity import Heterogeneity
from .loading import Loading
from .material import Material
from .names import Names
from .perturbation import Perturbation
from .quantities import ParameterError, Quantity, declarations, plain, quantity
from .recording import Recording
from .second_body import SecondBody

EVENT_DROP = 0.02
"""Fall of the driving force, as a fraction, that makes an event unless another is asked for."""


@dataclasses.dataclass(frozen=True)
class Geometry(Checked):
    """The deformable block ``0 <= x <= length``, ``0 <= y <= height``."""

    height: float = quantity("block height", unit="m", low=0.0, high=1e6, symbol="H", default=0.005)
    length: float = quantity("block length", unit="m", low=0.0, high=1e7, symbol="L", default=1.0)


@dataclasses.dataclass(frozen=True)
class Mesh(Checked):
    """The structured finite-element mesh: numbers of bilinear elements and grading in y."""

    n_x: int = quantity("number of elements along x", low=8, high=100000, closed="both",
                        symbol="N_x", default=400)  # fmt: skip
    n_y: int = quantity("number of elements along y", low=2, high=10000, closed="both",
                        symbol="N_y", default=150)  # fmt: skip
    grading: float = quantity(
        "height of the top row of elements over that of the bottom row", low=1.0, high=1000.0,
        closed="both", default=1.0,
    )  # fmt: skip


@dataclasses.dataclass(frozen=True)
class Stepping(Checked):
    """Control of the time integration."""

    end_time: float = quantity(
        "simulated time", unit="s", low=0.0, high=1e12, default=16.0, symbol="t"
    )
    time_after_event: float = quantity(
        "time simulated after the event's onset before the run may end", unit="s", low=0.0,
        high=1e12, closed="low", default=1e12 / 2,
    )  # fmt: skip
    event_drop: float = quantity(
        "fall of the driving force with which the event has begun, as a fraction; in the workflow "
        "extraction.drop if that is larger",
        low=0.0, high=1.0, default=EVENT_DROP,
    )  # fmt: skip
    tolerance: float = quantity(
        "tolerance of the local error of log slip rate and log state per step", low=0.0, high=1.0,
        default=1.0e-2,
    )  # fmt: skip
    longest_step: float = quantity(
        "longest time step over the memory time D/V", low=0.0, high=1.0, closed="high", default=0.1
    )
    shortest_step: float = quantity(
        "shortest time step, below which the run ends as failed", unit="s", low=0.0, high=1.0,
        default=1.0e-12,
    )  # fmt: skip


class Below(NamedTuple):
    """A second deformable block, with all that it has like the first one filled in."""

    material: Material
    geometry: Geometry
    mesh: Mesh
    bottom: str


@dataclasses.dataclass(frozen=True)
class Parameters:
    """Everything one simulation depends on; two equal objects give the same result."""

    material: Material = Material()
    friction: Friction = dataclasses.field(default_factory=Friction)  # finds its law by name
    loading: Loading = Loading()
    geometry: Geometry = Geometry()
    mesh: Mesh = Mesh()
    stepping: Stepping = Stepping()
    perturbation: Perturbation = Perturbation()
    heterogeneity: Heterogeneity = Heterogeneity()
    second_body: SecondBody = SecondBody()
    recording: Recording = Recording()

    def require_consistent(self) -> None:
        """Raise a ParameterError where groups of parameters do not go with one another.

        That is for a mesh or a second body that is not for the loading, and for a heterogeneity
        beside the block or less than an element wide.
        """
        kind, n_x = self.loading.kind, self.mesh.n_x
        if kind != "edge" and (n_x % 2 == 0) == (kind == "remote"):
            parity = "odd" if kind == "remote" else "even"
            raise ParameterError(
                f"mesh.n_x = {n_x} is not allowed with loading.kind = {kind}: it must be {parity}"
            )
        own, length = self.heterogeneity, self.geometry.length
        for name, low, high in (("centre", 0.0, length), ("width", length / n_x, length)):
            value = getattr(own, name)
            if own.varies != "none" and value is not None and not low <= value <= high:
                raise ParameterError(
                    f"heterogeneity.{name} = {value:g} m is not allowed: it must lie in "
                    f"[{low:.3g}, {high:.3g}] m, "
                    + ("on the block" if name == "centre" else "from an element to the block")
                )
        below = self.below
        if kind == "top" and below is not None and below.bottom != "clamped":
            raise ParameterError(
                f"second_body.bottom = {below.bottom} is not allowed with loading.kind = top, "
                "where nothing else holds the second block: it must be clamped"
            )

    def require_edge(self, what: str) -> None:
        """Raise a ParameterError, naming what is asked for, unless a uniform fault is pushed."""
        for key, value, needed in (
            ("loading.kind", self.loading.kind, "edge"),
            ("heterogeneity.varies", self.heterogeneity.varies, "none"),
        ):
            if value != needed:
                raise ParameterError(
                    f"{key} = {value} is not allowed with {what}, which is known of a uniform "
                    f"fault that is pushed at its edge alone: it must be {needed}; measure = "
                    "stability gives L_s of other faults, docs/loading.md"
                )

    @property
    def below(self) -> Below | None:
        """The second block, or None on a rigid base."""
        second = self.second_body
        if not second.deformable:
            return None

        def like_the_first(own: Any) -> Any:
            given = {f.name: getattr(second, f.name, None) for f in dataclasses.fields(own)}
            return dataclasses.replace(own, **{k: v for k, v in given.items() if v is not None})

        material, geometry, mesh = map(like_the_first, (self.material, self.geometry, self.mesh))
        return Below(material, geometry, mesh, second.bottom or "free")

    @property
    def memory_time(self) -> float:
        """Time ``D/V`` (s) over which friction forgets at the imposed velocity."""
        return self.friction.characteristic_slip_distance / self.loading.velocity

    @property
    def longest_step(self) -> float:
        """Longest time step (s), that of the stepping or what the perturbation asks for."""
        memory = self.memory_time
        return min(self.stepping.longest_step * memory, self.perturbation.longest_step(memory))

    def to_dict(self) -> dict[str, dict[str, Any]]:
        """The parameters as nested plain dictionaries."""
        return {name: plain(getattr(self, name)) for name in GROUPS}

    def named(self) -> dict[str, Any]:
        """The values by full name, ``geometry.height``."""
        groups = self.to_dict().items()
        return {f"{group}.{name}": value for group, own in groups for name, value in own.items()}

    @classmethod
    def from_dict(cls, values: dict[str, dict[str, Any]]) -> Parameters:
        """The inverse of :meth:`to_dict`; raises ParameterError for a bad value.

        Groups may be left out that records are older than: these are quiet, on a rigid base and
        record everything.
        """
        later = "perturbation", "heterogeneity", "second_body", "recording"
        values = {name: {} for name in later} | values
        return cls(**{name: group(**values[name]) for name, group in GROUPS.items()})

    def replaced(self, values: dict[str, Any]) -> Parameters:
        """A copy with other values, given by the full or short names of :func:`names`.

        Raises
        ------
        ParameterError
            For a bad value, a name that stands for no parameter, a parameter that is given twice,
            and one that the friction law does not have.
        """
        changes: dict[str, dict[str, Any]] = {group: {} for group in GROUPS}
        known = names()
        for name, value in values.items():
            group, _, field = known.full(name).partition(".")
            if field in changes[group]:
                raise ParameterError(f"{name} is given twice: it is {group}.{field}")
            changes[group][field] = value
        friction = self.friction.changed(changes.pop("friction"))
        others = {
            group: dataclasses.replace(getattr(self, group), **own)
            for group, own in changes.items()
            if own  # a study of thousands of runs changes one or two groups
        }
        return dataclasses.replace(self, friction=friction, **others)

    def to_json(self) -> str:
        """The parameters as JSON text, as datasets carry them."""
        return json.dumps(self.to_dict(), sort_keys=True)

    @classmethod
    def from_json(cls, text: str) -> Parameters:
        """The inverse of :meth:`to_json`."""
        return cls.from_dict(json.loads(text))


GROUPS: dict[str, type] = get_type_hints(Parameters)
"""The groups of :class:`Parameters` and their classes."""

ALIASES = {
    "evolution": "friction.evolution",
    "friction_law": "friction.law",
    "f": "friction_coefficient",
    "friction": "friction_coefficient",
    "friction_coefficient": "friction_coefficient",
    "a": "direct_effect",
    "direct_effect": "direct_effect",
    "b": "evolution_effect",
    "evolution_effect": "evolution_effect",
    "zeta": "velocity_weakening",
    "velocity_weakening": "velocity_weakening",
    "phi0": "loading.initial_state",
    "loading": "loading.kind",
    "heterogeneity": "heterogeneity.varies",
    "kind": "perturbation.kind",
    "perturbation": "perturbation.kind",
    "slip_distance": "friction.characteristic_slip_distance",
    "characteristic_slip_distance": "friction.characteristic_slip_distance",
    "applied_stress": "loading.normal_stress",
    "normal_stress": "loading.normal_stress",
    "block_length": "geometry.length",
    "length": "geometry.length",
    "shear_modulus": "material.shear_modulus",
    "poisson": "material.poisson_ratio",
    "poisson_ratio": "material.poisson_ratio",
    "density": "material.density",
    "height": "geometry.height",
    "n_y": "mesh.n_y",
    "grading": "mesh.grading",
    "second_far_side": "second_body.bottom",
    **{f"second_{name}": f"second_body.{name}" for name in declarations(SecondBody)},
    "second_body": "second_body.kind",
}
"""Short names by agreement, the one by which a parameter goes last; those without ``second_`` are
the first body's."""


@cache
def names() -> Names:
    """All parameters of a run, and the constants of friction, with their short names."""
    entries: dict[str, Quantity] = {}
    for group, cls in GROUPS.items():
        own = law_declarations() if group == "friction" else declarations(cls)
        entries |= {f"{group}.{name}": entry for name, entry in own.items()}
    return Names(entries | CONSTANTS, ALIASES)


FIRST_STEP = 2.0e-6  # over the memory time D/V
