"""All parameters of one simulation, as frozen and checked dataclasses in SI units."""

from __future__ import annotations

import dataclasses
import json
from functools import cache
from typing import Any, NamedTuple, TypeVar, get_type_hints

from .block import Geometry, Mesh
from .friction.constants import CONSTANTS
from .friction.law import Friction
from .friction.registry import law_declarations
from .heterogeneity import Heterogeneity
from .loading import Loading
from .material import Material
from .names import Names
from .perturbation import Perturbation
from .quantities import ParameterError, Quantity, declarations, plain
from .recording import Recording
from .second_body import SecondBody
from .stepping import Stepping

_Part = TypeVar("_Part", Material, Geometry, Mesh)


class _SecondBlock(NamedTuple):
    """A second deformable block, with the first one's values where it has none of its own."""

    material: Material
    geometry: Geometry
    mesh: Mesh
    far_side: str


@dataclasses.dataclass(frozen=True)
class Parameters:
    """Everything one simulation depends on; two equal objects give the same result.

    Examples
    --------
    >>> parameters = Parameters(geometry=Geometry(height=0.01, length=1.0))
    >>> parameters.geometry.height
    0.01
    """

    material: Material = Material()
    friction: Friction = dataclasses.field(default_factory=Friction)  # loads its law by name
    loading: Loading = Loading()
    geometry: Geometry = Geometry()
    mesh: Mesh = Mesh()
    stepping: Stepping = Stepping()
    perturbation: Perturbation = Perturbation()
    heterogeneity: Heterogeneity = Heterogeneity()
    second_body: SecondBody = SecondBody()
    recording: Recording = Recording()

    def require_consistent(self) -> None:
        """Check groups of parameters against each other.

        Raises
        ------
        ParameterError
            If the mesh does not fit the loading, or a heterogeneity is outside the block or
            narrower than an element.
        """
        self._require_parity()
        self._require_place_of_heterogeneity()

    def _require_parity(self) -> None:
        n_x = self.mesh.n_x
        if self.loading.kind == "remote" and n_x % 2 == 0:
            raise ParameterError(
                f"mesh.n_x = {n_x} is not allowed with loading.kind = remote: it must be odd"
            )

    def _require_place_of_heterogeneity(self) -> None:
        if self.heterogeneity.varies == "none":
            return
        length = self.geometry.length
        element = length / self.mesh.n_x
        for name, low, limits in (
            ("centre", 0.0, "on the block"),
            ("width", element, "from an element to the block"),
        ):
            value = getattr(self.heterogeneity, name)
            if value is not None and not low <= value <= length:
                raise ParameterError(
                    f"heterogeneity.{name} = {value:g} m is not allowed: it must lie in "
                    f"[{low:.3g}, {length:.3g}] m, {limits}"
                )

    def require_edge(self, computation: str) -> None:
        """Check that the fault is uniform and pushed at its edge.

        Parameters
        ----------
        computation : str
            The computation that needs such a fault, for the message.

        Raises
        ------
        ParameterError
            If the fault is another one.
        """
        for key, value, needed in (
            ("loading.kind", self.loading.kind, "edge"),
            ("heterogeneity.varies", self.heterogeneity.varies, "none"),
        ):
            if value != needed:
                raise ParameterError(
                    f"{key} = {value} is not allowed with {computation}, which applies only to a "
                    f"uniform fault that is pushed at its edge: it must be {needed}; measure = "
                    "stability gives L_s of other faults, docs/loadings.md"
                )

    @property
    def below(self) -> _SecondBlock | None:
        """The second block, or None on a rigid base."""
        second = self.second_body
        if not second.deformable:
            return None

        def like_the_first(own: _Part) -> _Part:
            changes = {}
            for field in dataclasses.fields(own):
                value = getattr(second, field.name, None)
                if value is not None:
                    changes[field.name] = value
            return dataclasses.replace(own, **changes)

        return _SecondBlock(
            like_the_first(self.material),
            like_the_first(self.geometry),
            like_the_first(self.mesh),
            second.far_side or "free",
        )

    @property
    def memory_time(self) -> float:
        """Time ``D/V`` (s) over which friction forgets at the imposed velocity."""
        return self.friction.slip_distance / self.loading.velocity

    @property
    def longest_step(self) -> float:
        """Longest time step (s): the shorter limit of the stepping and of the perturbation."""
        memory = self.memory_time
        return min(self.stepping.longest_step * memory, self.perturbation.longest_step(memory))

    def to_dict(self) -> dict[str, dict[str, Any]]:
        """The parameters as nested plain dictionaries."""
        return {name: plain(getattr(self, name)) for name in GROUPS}

    def named(self) -> dict[str, Any]:
        """The values by full name, ``geometry.height``."""
        found = {}
        for group, own in self.to_dict().items():
            for name, value in own.items():
                found[f"{group}.{name}"] = value
        return found

    @classmethod
    def from_dict(cls, values: dict[str, dict[str, Any]]) -> Parameters:
        """The inverse of :meth:`to_dict`; raises ParameterError for a bad value.

        Older records lack some groups: their runs are unperturbed, uniform and on a rigid base,
        and record all fields.
        """
        added_later = ("perturbation", "heterogeneity", "second_body", "recording")
        values = {name: {} for name in added_later} | values
        return cls(**{name: group(**values[name]) for name, group in GROUPS.items()})

    def replaced(self, values: dict[str, Any]) -> Parameters:
        """A copy with other values, by full or short name (:func:`names`).

        Raises
        ------
        ParameterError
            For a bad value, an unknown name, a parameter that is given twice, and one that the
            friction law does not have.
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
        """The parameters as JSON text, for datasets."""
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
    "f": "friction",
    "friction_coefficient": "friction",
    "friction": "friction",
    "direct_effect": "a",
    "a": "a",
    "evolution_effect": "b",
    "b": "b",
    "velocity_weakening": "zeta",
    "zeta": "zeta",
    "phi0": "loading.initial_state",
    "initial_state": "loading.initial_state",
    "loading": "loading.kind",
    "heterogeneity": "heterogeneity.varies",
    "kind": "perturbation.kind",
    "perturbation": "perturbation.kind",
    "characteristic_slip_distance": "friction.slip_distance",
    "slip_distance": "friction.slip_distance",
    "applied_stress": "loading.normal_stress",
    "normal_stress": "loading.normal_stress",
    "length": "geometry.length",
    "block_length": "geometry.length",
    "shear_modulus": "material.shear_modulus",
    "poisson": "material.poisson_ratio",
    "poisson_ratio": "material.poisson_ratio",
    "density": "material.density",
    "height": "geometry.height",
    "n_y": "mesh.n_y",
    "grading": "mesh.grading",
    "second_bottom": "second_body.far_side",
    **{f"second_{name}": f"second_body.{name}" for name in declarations(SecondBody)},
    "second_body": "second_body.kind",
}
"""Short names; of several for one parameter the last is the standard one.

Names without ``second_`` are the first body's.
"""


@cache
def names() -> Names:
    """All parameters of a run, and the constants of friction, with their short names."""
    entries: dict[str, Quantity] = {}
    for group, cls in GROUPS.items():
        own = law_declarations() if group == "friction" else declarations(cls)
        for name, entry in own.items():
            entries[f"{group}.{name}"] = entry
    return Names(entries | CONSTANTS, ALIASES)
