"""One simulation: a fault with its block, mesh, steps, perturbation, heterogeneity and record."""

from __future__ import annotations

import dataclasses
import json
import math
from collections.abc import Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple, Self

from ..fault import PAPER, Fault
from ..model.friction import Friction
from ..model.friction.constants import with_constants
from ..model.heterogeneity import Heterogeneity
from ..model.material import Material
from ..model.quantities import ParameterError
from ..model.settings import Block, Perturbation, Start, Stepping
from .complete import complete, flat, time_to_length, zone_length
from .names import GROUPS, OF_GROUPS, OF_LAWS, OF_PARTS, read, sections

if TYPE_CHECKING:
    from ..theory.creep.patches import Patches
    from .reach import Reach


class Body(NamedTuple):
    """An elastic block with its mesh and the condition on its far side."""

    material: Material
    length: float  # m
    height: float  # m
    n_x: int
    n_y: int
    grading: float
    far_side: str


@dataclasses.dataclass(frozen=True)
class Run:
    """Everything that one simulation depends on; two equal runs give the same record.

    Parameters
    ----------
    fault : Fault
        A single fault with velocity, friction and heights; half-spaces become blocks 4 L_c high.
    **values
        Parameters of the run by name, as numbers in SI units or texts such as "8m":
        ``block_length``, 6 L_c if left out, ``n_x``, ``n_y``, ``perturbation``, ``strength``,
        ``end_time`` and so on; `nucleation simulate --help` lists them.

    Raises
    ------
    ParameterError
        If the fault can't be simulated, or values are not allowed or contradict each other.

    Examples
    --------
    >>> from nucleation.api import PAPER, Run
    >>> run = Run(PAPER, n_x=400, n_y=20)
    >>> run.block.length, run.fault.height
    (1.428, 0.005)
    """

    fault: Fault
    law: Friction
    """The full friction law, of which f, a, zeta and D of the fault are the expansion at V."""
    start: Start
    block: Block
    stepping: Stepping
    perturbation: Perturbation
    heterogeneity: Heterogeneity

    def __init__(self, fault: Fault, **values: Any) -> None:
        self._set(complete(fault, read(values)))

    @classmethod
    def _of(cls, values: Mapping[str, Any], **parts: Any) -> Self:
        """The run of a flat mapping of all parameters, with the parts that are made already."""
        run = object.__new__(cls)
        run._set(values, **parts)
        return run

    def completed(self, **values: Any) -> Self:
        """A run of the same fault and friction law in which only `values` are given."""
        return self._of(complete(self.fault, read(values), self.law))

    def _set(self, values: Mapping[str, Any], **parts: Any) -> None:
        """Set the fields from a flat mapping of all parameters, unless they are given as parts."""
        if "law" not in parts:
            own = {name: values[name] for name in sections()["friction"] if name in values}
            parts["law"] = Friction(law=own.pop("friction_law"), **own)
        if "fault" not in parts:
            parts["fault"] = _fault_of(values, parts["law"])
        for group, cls in GROUPS.items():
            if group not in parts:
                fields = zip(OF_GROUPS[group], dataclasses.fields(cls), strict=True)
                own = {field.name: values[name] for name, field in fields if name in values}
                parts[group] = cls(**own)
        vars(self).update(parts)

    @classmethod
    def from_dict(cls, values: Mapping[str, Any]) -> Self:
        """The run of :meth:`to_dict`; a ParameterError names what is wrong or missing."""
        if not isinstance(values, Mapping) or "shear_modulus" not in values:
            raise ParameterError(
                "the parameters are no run of this version: records of earlier versions are made "
                "again by their simulations"
            )
        return cls._of(read(values))

    def to_dict(self) -> dict[str, Any]:
        """All parameters by name, in SI units; without those of a second body like the first."""
        found = flat(self.fault, self.law)
        for group in GROUPS:
            own = getattr(self, group)
            for name, value in vars(own).items():
                if value is not None:
                    found[own.called.get(name, name)] = value
        return found

    def to_json(self) -> str:
        """:meth:`to_dict` as JSON, for datasets."""
        return json.dumps(self.to_dict(), sort_keys=True)

    @classmethod
    def from_json(cls, text: str) -> Self:
        """The inverse of :meth:`to_json`."""
        try:
            values = json.loads(text)
        except RecursionError:
            raise ParameterError("the parameters are nested too deeply for a run") from None
        return cls.from_dict(values)

    def replaced(self, **values: Any) -> Self:
        """A copy with other parameters of the fault, its friction or the run, by name.

        Parameters
        ----------
        **values
            Numbers in SI units or texts such as "8m"; ``None`` makes a parameter of the second
            body that of the first. The constants a, b, zeta, zeta_over_a and friction change the
            friction law.

        Returns
        -------
        Run

        Raises
        ------
        ParameterError
            If a value is not allowed, or the law has no such parameter or constants.
        """
        given = read(values)
        before = own = self.to_dict()
        if given.get("second_body") == "rigid":
            own = {name: x for name, x in before.items() if not name.startswith("second_")}
        changed = {**own, **given}
        of_law = {name: x for name, x in given.items() if name in OF_LAWS}
        if "friction_law" in of_law:
            of_law["law"] = of_law.pop("friction_law")
        law = with_constants(self.law.changed(of_law), changed["velocity"], given)
        moved = {name for name in before | changed if before.get(name) != changed.get(name)}
        kept = {
            group: getattr(self, group) for group in GROUPS if moved.isdisjoint(OF_GROUPS[group])
        }
        if moved <= OF_PARTS:
            kept["fault"] = self.fault
        changed = {name: x for name, x in changed.items() if x is not None}
        return self._of(changed, law=law, **kept)

    @property
    def upper(self) -> Body:
        """The first block."""
        return self._body("")

    @property
    def below(self) -> Body | None:
        """The second block, or None on a rigid base."""
        return None if math.isinf(self.fault.second_shear_modulus) else self._body("second_")

    def _body(self, prefix: str) -> Body:
        """The block whose parameters of the fault have the prefix."""
        fault, block = self.fault, self.block
        names = ("shear_modulus", "poisson_ratio", "density")
        values = {name: getattr(fault, prefix + name) for name in names}
        return Body(
            Material(**values, plane=fault.plane),
            block.length,
            getattr(fault, f"{prefix}height"),
            block.n_x,
            getattr(block, f"{prefix}n_y") or block.n_y,
            getattr(block, f"{prefix}grading") or block.grading,
            str(getattr(fault, f"{prefix}far_side")),
        )

    @property
    def memory_time(self) -> float:
        """Time ``D/V`` (s) over which friction forgets at the imposed velocity."""
        return self.law.slip_distance / self.fault.velocity

    @property
    def longest_step(self) -> float:
        """Longest time step (s): the shorter limit of the stepping and of the perturbation."""
        memory = self.memory_time
        return min(self.stepping.longest_step * memory, self.perturbation.longest_step(memory))

    @cached_property
    def critical_length(self) -> float:
        """L_c (m) of the fault; NaN where sliding is stable at every wavelength."""
        return float(self.fault.critical_length())

    def process_zone(self, rest: float = 0.0) -> float:
        """Length (m) of the front's process zone after a time (s) at rest ahead of it."""
        return zone_length(self.fault, self.law, rest)

    def growth_time(self, length: float) -> float:
        """Time (s) from the start until the creep patch has a length (m), roughly."""
        return time_to_length(self.fault, self.start, length)

    @property
    def patches(self) -> Patches:
        """The creeping patches of the fault, with the run's own friction law.

        They begin at the edge that is pushed, or in the interior under a remote load.
        """
        from .reach import patches_of

        return patches_of(self.fault, self.law, self.start)

    @property
    def longest_reach(self) -> float:
        """A length (m) that no drop is beyond, in no time."""
        from .reach import longest_reach

        return longest_reach(self.fault, self.critical_length)

    @property
    def reach(self) -> Reach:
        """L_s, the expected L and the upper end of its range (m), by theory."""
        from .reach import reach_of

        return reach_of(self.fault, self.law, self.start, self.perturbation, self.critical_length)


def _fault_of(values: Mapping[str, Any], law: Friction) -> Fault:
    """The fault in a flat mapping of parameters."""
    names = (*sections()["material"], "normal_stress", "velocity", "initial_state", "loading")
    found = {name: values[name] for name in (*names, "height")}
    for name in sections()["second_body"]:
        if values.get(name) is not None and name not in ("second_n_y", "second_grading"):
            found[name] = values[name]
    found |= {"far_side": "free", "evolution": law.evolution}
    if found.pop("second_body") == "rigid":
        extra = [name for name in found if name.startswith("second_")]
        if extra:
            raise ParameterError(
                f"{extra[0]} = {found[extra[0]]!r} is not allowed with second_body = rigid, a base "
                f"that does not deform: leave {extra[0]} out, or make second_body deformable"
            )
        found["second_shear_modulus"] = math.inf
    if found.get("second_far_side") == "traction":
        found["second_far_side"] = "free"  # the other word for it
    if found["loading"] == "edge":
        return Fault(**found, friction_law=law)
    f, a, zeta = law.expansion(found["velocity"])
    return Fault(**found, friction=f, a=a, zeta=zeta, slip_distance=law.slip_distance)


PAPER_RUN = Run._of(flat(PAPER, PAPER.law()))
"""The paper's fault on the paper's mesh, without a declared perturbation."""
