"""One simulation: a fault with its block, mesh, steps, perturbation, heterogeneity and record."""

from __future__ import annotations

import dataclasses
import json
import math
from collections.abc import Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple, Self

from ..fault import PAPER, Fault
from ..fault.parameters import PARTS, by_part, read, values_of
from ..model.friction import Friction
from ..model.friction.constants import with_constants
from ..model.heterogeneity import Heterogeneity
from ..model.material import Material
from ..model.quantities import ParameterError
from ..model.settings import Block, Perturbation, Start, Stepping
from .sizing import (
    fault_with,
    sized,
    time_to_length,
    values_of_fault,
    without_followers,
    zone_length,
)

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

    :meth:`sized` makes one from a fault and some parameters, and completes it.

    Parameters
    ----------
    fault : Fault
        A single fault with velocity, friction and finite heights.
    law : Friction
        The full friction law, of which f, a, zeta and D of the fault are the expansion at V.
    start, block, stepping, perturbation, heterogeneity
        The parts of the run; what they leave out is the paper's.

    Examples
    --------
    >>> from nucleation.api import PAPER, Run
    >>> run = Run.sized(PAPER, n_x=400, n_y=20)
    >>> run.block.length, run.fault.height
    (1.428, 0.005)
    """

    fault: Fault
    law: Friction
    start: Start = Start()
    block: Block = Block()
    stepping: Stepping = Stepping()
    perturbation: Perturbation = Perturbation()
    heterogeneity: Heterogeneity = Heterogeneity()

    @classmethod
    def sized(cls, fault: Fault, law: Friction | None = None, **values: Any) -> Self:
        """The run of a fault with some parameters; its block, mesh and times follow by theory.

        Parameters
        ----------
        fault : Fault
            A single fault with velocity and friction; half-spaces become blocks 4 L_c high.
        law : Friction, optional
            The full friction law; that of the fault if left out.
        **values
            Parameters of the run by name, as numbers in SI units or texts such as "8m":
            ``block_length``, 6 L_c if left out, ``n_x``, ``n_y``, ``perturbation``, ``strength``,
            ``end_time`` and so on; `nucleation simulate --help` lists them.

        Returns
        -------
        Run

        Raises
        ------
        ParameterError
            If the fault can't be simulated, or values are not allowed or contradict each other.
        """
        return cls(**sized(fault, law, read(values)))

    @classmethod
    def from_dict(cls, values: Mapping[str, Any]) -> Self:
        """The run of :meth:`to_dict`; a ParameterError names what is wrong or missing."""
        if not isinstance(values, Mapping) or "shear_modulus" not in values:
            raise ParameterError(
                "the parameters are no run of this version: records of earlier versions are made "
                "again by their simulations"
            )
        given = by_part(read(values))
        law = Friction(**given["law"])
        parts = {part: cls_of(**given[part]) for part, cls_of in PARTS.items()}
        return cls(fault_with(law, given["fault"] | given[""]), law, **parts)

    def to_dict(self) -> dict[str, Any]:
        """All parameters by name, in SI units, of both bodies."""
        found = values_of_fault(self.fault, self.law)
        for part in PARTS:
            found |= values_of(part, getattr(self, part))
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
            friction law; ``friction_law`` is its name, or a whole :class:`Friction`.

        Returns
        -------
        Run

        Raises
        ------
        ParameterError
            If a value is not allowed, or the law has no such parameter or constants.
        """
        law = values.get("friction_law")
        if isinstance(law, Friction):
            values = values | vars(law) | {"friction_law": law.law}
            del values["law"]
        changes = read(values)
        given = by_part(changes)
        block = given["block"]
        own = without_followers(values_of_fault(self.fault, self.law))
        if given[""].get("second_body") == "rigid":
            own = {name: x for name, x in own.items() if not name.startswith("second_")}
            block = {"second_n_y": None, "second_grading": None} | block
        of_fault = own | given["fault"] | given[""]
        law = with_constants(self.law.changed(given["law"]), of_fault["velocity"], changes)
        fault = self.fault
        if law != self.law or given["fault"] or "second_body" in changes:
            fault = fault_with(law, of_fault)
        parts = {part: getattr(self, part) for part in PARTS}
        for part, fields in (given | {"block": block}).items():
            if part in PARTS and fields:
                parts[part] = dataclasses.replace(parts[part], **fields)
        return type(self)(fault, law, **parts)

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


PAPER_RUN = Run(PAPER, PAPER.law())
"""The paper's fault on the paper's mesh, without a declared perturbation."""
