"""What a simulation asks of an elastic body: to be condensed on its interface, and to move on.

These are the doors for further bodies: what has these methods can slide, a block or a pair of them.
The interface sees of a body only how its forces follow its displacement ``w`` (m), the slip less
that of the driven edge:

    p = p0 + D w,    R = R0 + N w

with the nodal tangential force p (N/m) at the free nodes and the nodal normal force R at the
nodes 0..n_x, both on the (upper) body, R > 0 in compression. Free are the nodes 1..n_x; node 0 is
that of the driven edge, repeats node n_x in a periodic body, or is free as well if no edge is
driven (:mod:`.free_block`), and is counted from one like the others. For one block on a rigid base
w is its displacement at the interface, for two bodies the difference of theirs.
"""

import dataclasses
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from ..types import Array
from .grid import Field, Grid, Motion, Motions, Terms


@dataclasses.dataclass(frozen=True)
class Response:
    """Nodal forces (N/m) that hold the interface at given `w` (m), the bulk in balance.

    `w` and `tangential` at the nodes 1..n_x, `normal` at 0..n_x.
    """

    w: Array
    tangential: Array
    normal: Array


class Condensed(Protocol):
    """D and N of a body: all that the interface's equations need."""

    @property
    def body(self) -> Any:
        """The :class:`Body` itself."""

    @property
    def diagonal(self) -> Array:
        """Diagonal of D (N/m per m) at the nodes 1..n_x."""

    def apply(self, w: Array) -> tuple[Array, Array]:
        """``D w`` at the nodes 1..n_x and ``N w`` at the nodes 0..n_x (N/m), for w (m)."""

    def tangent(self, nodes: NDArray[np.intp], dtype: type = float) -> tuple[NDArray, NDArray]:
        """Dense blocks of D and N between some nodes (sorted, in 1..n_x), (n, n) each."""


class Expectation(NamedTuple):
    """From what a body may foresee its own unknowns at the end of a step."""

    motions: Sequence[Motion]  # the present one first
    step: float  # s, to come
    last_step: float  # s, zero at the start
    memory: Array  # what the body itself has left there in the last step


class Balance(NamedTuple):
    """A body in balance at the end of a step."""

    displacement: Field
    memory: Array  # what the body wants to know in the next step, opaque to others
    holds: bool  # whether the response was good enough; if not, the next one is


class Operator(Condensed, Protocol):
    """``K + s M`` of a body for one ``s``, factorised."""

    s: float  # 1/s^2

    @property
    def megabytes(self) -> float:
        """Memory that the operator holds (MB)."""

    def respond(self, load: Field, w: Array) -> Any:
        """The :class:`Response` at `w` (m) under a load (N/m)."""

    def responses(self, load: Field, w: Array, expected: Expectation) -> Iterator[Any]:
        """The same response, at first perhaps one that is cheaper, if expectations come true."""

    def balance(self, response: Any, w: Array, expected: Expectation | None = None) -> Balance:
        """The body at `w` (m), once the interface has been solved with a response (used up)."""


class Body(Protocol):
    """An elastic body on an interface."""

    grid: Grid  # whose lowest nodes are those of the interface

    @property
    def grid_below(self) -> Grid | None:
        """The mesh of a second body, upside down: its lowest nodes are those of the interface."""

    @property
    def free_nodes(self) -> int:
        """Number of the interface's nodes that friction moves."""

    def on_all_nodes(self, values: Array, driven: float) -> Array:
        """Values at the free nodes and that of the driven edge's own node, at the nodes 0..n_x."""

    @property
    def crossing_time(self) -> float:
        """Time (s) in which shear waves cross the body."""

    @property
    def no_memory(self) -> Array:
        """The memory of a body that has not stepped yet."""

    def operator(self, s: float) -> Any:
        """The :class:`Operator` ``K + s M``."""

    def at_rest(self, displacement: Field, velocity: float) -> Motion:
        """The motion of a body at rest, seen from its driven edge that moves at a velocity."""

    @property
    def total_mass(self) -> float:
        """Mass (kg/m) that moves with the driven edge."""

    def translation_load(self, acceleration: float) -> Field:
        """Inertia (N/m) against an acceleration (m/s^2) of the driven edge and all with it."""

    def inertia_load(self, s: float, terms: Terms, load: Field | None = None) -> Field:
        """``load + s M sum_i c_i f_i`` for terms ``(c_i, f_i)``."""

    def motion(
        self, past: Sequence[float], beta: float, displacement: Field, motions: Sequence[Motion]
    ) -> Motion:
        """The motion at a new displacement, its rate by ``u = sum_i past_i u_i + beta du/dt``."""

    def settled(self, motions: Motions, step: float, slid: float) -> Motions:
        """The motions without what grows from rounding alone; see :meth:`.pair.Pair.settled`."""

    def nodal_values(self, field: Field) -> tuple[Array, Array]:
        """Nodal w_x and u_y of the (upper) body, levels from the interface up."""

    def nodal_values_below(self, field: Field) -> tuple[Array, Array]:
        """Nodal u_x and u_y of a second body, levels from the interface down."""
