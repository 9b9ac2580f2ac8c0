"""The interface of elastic bodies to a simulation: their condensed equations and their motion.

A further elastic body, one block or a pair, has the methods of :class:`ElasticBody`; its operator
has those of :class:`Operator`. Through the operator, the interface sees how the forces of the body
follow its displacement ``w`` (m), the slip less that of the driven edge:

    p = p0 + D w,    R = R0 + N w

with the nodal tangential force p (N/m) at the free nodes and the nodal normal force R at the nodes
0..n_x, both on the (upper) body, R > 0 in compression. The free nodes are 1..n_x. Node 0 belongs to
the driven edge; in a periodic body it repeats node n_x. For one block on a rigid base w is its
displacement at the interface, for two bodies the difference of their displacements.
"""

from __future__ import annotations

import dataclasses
from abc import ABC, abstractmethod
from collections.abc import Iterator, Sequence
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..types import Array
from .field_kernels import rate_of_change
from .grid import Components, Field, Grid, Motion, Motions, Terms

Nodes = NDArray[np.intp]
"""Numbers of nodes of the interface."""

Blocks = tuple[NDArray, NDArray]
"""D and N between some nodes."""


@dataclasses.dataclass(frozen=True)
class Response:
    """Nodal forces (N/m) that hold the interface at a given displacement, the bulk in balance.

    Parameters
    ----------
    w : ndarray
        The displacement (m) at the free nodes.
    tangential : ndarray
        Forces along x at the free nodes.
    normal : ndarray
        Forces along y at the nodes 0..n_x.
    load : Field
        The load of the body (N/m).
    swept : ndarray, optional
        The load swept down to the interface (N/m), from where the operator continues.
    start : ndarray, optional
        Displacement (m) of a pair's interface under the load at w = 0.
    edge : ndarray, optional
        Values of a free right edge (m).
    """

    w: Array
    tangential: Array
    normal: Array
    load: Field
    swept: Array | None = None
    start: Array | None = None
    edge: Array | None = None


class Expectation(NamedTuple):
    """From this a body may predict its own unknowns at the end of a step.

    Parameters
    ----------
    motions : sequence of Motion
        Motions of the body, the present one first.
    step, last_step : float
        The step to come and the step before it (s); zero if there was none.
    memory : ndarray
        The memory of the body's last :class:`Balance`.
    """

    motions: Sequence[Motion]
    step: float
    last_step: float
    memory: Array


class Balance(NamedTuple):
    """A body in balance at the end of a step.

    Parameters
    ----------
    displacement : Field
        The displacement (m).
    memory : ndarray
        Numbers that the body needs in the next step; only the body reads them.
    holds : bool
        Whether the response was accurate enough. If not, the next one is needed.
    """

    displacement: Field
    memory: Array
    holds: bool


class Operator(ABC):
    """``K + s M`` of a body for one ``s``, factorised and condensed on the interface.

    Attributes
    ----------
    body : ElasticBody
        The body itself.
    s : float
        Factor of the mass matrix (1/s^2); zero is statics.
    """

    body: ElasticBody
    s: float

    @cached_property
    def dense(self) -> Components:
        """D and N between all free nodes (N/m per m), a column for each node that moves."""
        units = np.eye(self.body.free_nodes)
        columns = [self.apply(unit) for unit in units]
        stiffness = np.column_stack([tangential for tangential, _ in columns])
        coupling = np.column_stack([normal for _, normal in columns])
        return stiffness, coupling

    @property
    def diagonal(self) -> Array:
        """Diagonal of D (N/m per m) at the free nodes."""
        stiffness, _ = self.dense
        return np.ascontiguousarray(stiffness.diagonal())

    @property
    @abstractmethod
    def megabytes(self) -> float:
        """Memory that the operator holds once all of its parts are in use (MB)."""

    @abstractmethod
    def apply(self, w: Array) -> Components:
        """Return ``D w`` at the free nodes and ``N w`` at the nodes 0..n_x (N/m), for w (m)."""

    def tangent(self, nodes: Nodes, dtype: type = float) -> Blocks:
        """Return dense blocks of D and N between some free nodes.

        Parameters
        ----------
        nodes : ndarray of int
            Numbers of the nodes from one on, sorted, shape (n,).
        dtype : type
            Type of the result's numbers.

        Returns
        -------
        stiffness, coupling : ndarray
            D and N (N/m per m), shape (n, n) each.
        """
        stiffness, coupling = self.dense
        if nodes.size < len(stiffness):
            block = np.ix_(nodes - 1, nodes - 1)
            stiffness = stiffness[block]
            coupling = coupling[block]
        return stiffness.astype(dtype), coupling.astype(dtype)

    @abstractmethod
    def respond(self, load: Field, w: Array) -> Response:
        """Find the forces that hold the interface.

        Parameters
        ----------
        load : Field
            The load of the body (N/m).
        w : ndarray
            Displacement of the interface (m) at the free nodes.

        Returns
        -------
        Response
        """

    def responses(
        self,
        load: Field,
        w: Array,
        expected: Expectation,
    ) -> Iterator[Response]:
        """Yield responses as of :meth:`respond`, cheaper ones first; the last one always holds.

        Parameters
        ----------
        load, w : Field, ndarray
            As in :meth:`respond`.
        expected : Expectation
            A cheaper response holds if this comes true.
        """
        yield self.respond(load, w)

    @abstractmethod
    def balance(
        self,
        response: Response,
        w: Array,
        expected: Expectation | None = None,
    ) -> Balance:
        """Find the body's displacement once the interface has been solved.

        Parameters
        ----------
        response : Response
            A response of this operator. It must not be used again.
        w : ndarray
            The solution at the interface (m) at the free nodes.
        expected : Expectation, optional
            That of the response; without one, nothing is to be compared.

        Returns
        -------
        Balance
        """


class ElasticBody(ABC):
    """An elastic body on an interface.

    Attributes
    ----------
    grid : Grid
        The mesh of the (upper) body; its lowest nodes are those of the interface.
    grid_below : Grid or None
        The mesh of a second body, upside down: its lowest nodes are those of the interface.
    far_side : str
        Boundary condition of the (upper) body's far side, a key of :data:`.separable.HELD`.
    free_nodes : int
        Number of the interface's nodes that friction moves.
    crossing_time : float
        Time (s) in which shear waves cross the body.
    total_mass : float
        Mass (kg/m) that moves with the driven edge.
    """

    grid: Grid
    grid_below: Grid | None = None
    far_side: str
    free_nodes: int
    crossing_time: float
    total_mass: float

    @property
    def no_memory(self) -> Array:
        """The memory of a body that has not stepped yet; empty if it never has any."""
        return np.empty(0)

    @abstractmethod
    def operator(self, s: float) -> Operator:
        """Factorise the dynamic stiffness ``K + s M`` (`s` in 1/s^2)."""

    @abstractmethod
    def on_all_nodes(self, values: Array, driven: float) -> Array:
        """Add the node of the driven edge to the free nodes.

        Parameters
        ----------
        values : ndarray
            Values at the free nodes.
        driven : float
            Value at the driven edge's own node, if there is such an edge.

        Returns
        -------
        ndarray
            Values at the nodes 0..n_x.
        """

    @abstractmethod
    def top_load(self, normal_stress: float) -> Field:
        """Return the nodal forces (N/m) of a compressive stress (Pa) on the far side."""

    @abstractmethod
    def translation_load(self, acceleration: float) -> Field:
        """Return the inertia (N/m) against an acceleration (m/s^2) of the driven edge.

        All that moves with the edge is accelerated along x.
        """

    @abstractmethod
    def inertia_load(
        self,
        s: float,
        terms: Terms,
        load: Field | None = None,
    ) -> Field:
        """Add the inertia of a linear combination of fields to a load.

        Parameters
        ----------
        s : float
            Factor of the mass matrix (1/s^2).
        terms : sequence of (float, Field)
            At most four coefficients c_i and fields f_i (m).
        load : Field, optional
            The load (N/m), by default zero.

        Returns
        -------
        Field
            ``load + s M sum_i c_i f_i`` (N/m).
        """

    @abstractmethod
    def at_rest(self, displacement: Field, velocity: float) -> Motion:
        """Return the motion of a body at rest, seen from its driven edge.

        Parameters
        ----------
        displacement : Field
            The displacement (m).
        velocity : float
            Velocity of the driven edge (m/s).

        Returns
        -------
        Motion
        """

    @abstractmethod
    def momentum_x(self, velocity: Field) -> float:
        """Return the momentum along x (kg/s per unit depth) of a velocity field w_t (m/s).

        It is that of the body that moves with the driven edge.
        """

    def motion(
        self,
        past: Sequence[float],
        beta: float,
        displacement: Field,
        motions: Sequence[Motion],
    ) -> Motion:
        """Return the motion at a new displacement by ``u = c1 u_1 + c2 u_2 + beta du/dt``.

        Parameters
        ----------
        past : (float, float)
            The coefficients c1 and c2.
        beta : float
            The coefficient of the rate (s).
        displacement : Field
            The new displacement u (m).
        motions : sequence of Motion
            Past motions, the newest first; if there is one only, it is both u_1 and u_2.

        Returns
        -------
        Motion
        """
        c1, c2 = past
        newest = motions[0].displacement
        oldest = motions[-1].displacement
        modes = np.empty_like(displacement.modes)
        rate_of_change(
            c1,
            c2,
            beta,
            displacement.modes,
            newest.modes,
            oldest.modes,
            modes,
        )
        edge = (displacement.edge - c1 * newest.edge - c2 * oldest.edge) / beta
        velocity = Field(modes, edge)
        return Motion(displacement, velocity, self.momentum_x(velocity))

    def settled(
        self,
        motions: Motions,
        step: float,
        slid: float,
    ) -> Motions:
        """Remove parts of a motion that grow from round-off alone; here there are none.

        Parameters
        ----------
        motions : tuple of Motion
            Motions of the body, the newest first.
        step : float
            Time between the first two motions (s).
        slid : float
            Largest displacement of the interface (m).

        Returns
        -------
        tuple of Motion
        """
        return motions

    @abstractmethod
    def nodal_values(self, field: Field) -> Components:
        """Return nodal w_x and u_y of the (upper) body, levels from the interface up.

        Each has the shape (n_y + 1, n_x + 1).
        """

    def nodal_values_below(self, field: Field) -> Components:
        """Return nodal u_x and u_y of a second body, levels from the interface down."""
        raise NotImplementedError("there is no second body")
