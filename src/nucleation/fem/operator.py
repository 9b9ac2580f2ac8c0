"""``K + s M`` of a body for one s, condensed on the nodes of its interface.

A load is swept down to the interface; once the interface's displacement is known, the way back
gives that of the bulk. The friction sees how the forces of the body follow the displacement ``w``
(m) at the nodes 1..n_x, the slip less that of the driven edge:

    p = p0 + D w,    R = R0 + N w

with the nodal tangential force p (N/m) at the nodes 1..n_x and the nodal normal force R at 0..n_x,
both on the upper body, R > 0 in compression; D is symmetric positive definite. Between modes D and
N are diagonal; a free right edge adds a term of low rank.

Two bodies are put in series mode by mode. Each has a stiffness ``S = [[a, b], [b, c]]`` and a
reduced load r; the mirror changes the signs of b2 and of the y component of r2. Then

    (w1, u_y) = T^-1 [S2 (w, 0) + r1 + r2],    T = S1 + S2,
    (p, R) = S1 (w1, u_y) - r1 .

So ``D = (det S2 a1 + det S1 a2) / det T`` and ``N = (det S2 b1 + det S1 b2) / det T`` per mode; N
of identical bodies vanishes exactly. If no far side is held, all of ``u_y`` may shift: in motion
inertia determines the shift; in statics, where no force acts on it, the corner of blocks and the
mean of a period stay.
"""

from __future__ import annotations

import dataclasses
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy import fft

from ..types import Array
from . import edge_kernels, kernels
from .body import Body
from .factors import Before, LayerFactors
from .grid import Components, Field
from .right_edge import EdgeValues

Blocks = tuple[NDArray, NDArray]
"""D and N between some nodes."""

EDGE_FELT = 1e-16  # of a node's own stiffness, squared coupling: 1e-8 in the coupling


@dataclasses.dataclass(frozen=True)
class Forces:
    """Nodal forces that hold the interface at a given displacement, the bulk in balance."""

    w: Array  # m, at the nodes 1..n_x
    tangential: Array  # N/m, at the nodes 1..n_x
    normal: Array  # N/m, at the nodes 0..n_x


@dataclasses.dataclass(frozen=True)
class Response(Forces):
    """These forces, and from what the bulk follows."""

    load: Field  # N/m, of the body
    edge: Array  # m, the edge values


class Operator:
    """``K + s M`` of a body for one ``s`` (1/s^2), with ``s = 0`` for statics.

    `modal` has D and N per mode, a right edge held, times 2/n_x (N/m per m), (2, n_x). `by_slip` is
    (w1, u_y) per unit of w. In a pair `compliance` is T^-1 (xx, xy, yy), and `forces` are S1 T^-1
    and S2 T^-1 (xx, xy, yx, yy of each).
    """

    def __init__(self, body: Body, s: float) -> None:
        self.body = body
        self.s = s
        self.factors = [LayerFactors(layer, s) for layer in body.layers]
        self.moves = s * sum(layer.material.density for layer in body.layers) > 0.0
        if len(self.factors) == 2:
            with np.errstate(invalid="ignore", divide="ignore"):
                self._put_in_series()
        else:
            self.modal = self.factors[0].pivot[:2]  # the first row, as u_y is zero
            self.by_slip = np.array([[1.0], [0.0]])
        self._no_load = np.zeros(self.modal.shape)
        self._last_key: tuple[bytes, type] | None = None
        self._last_blocks: Blocks
        self.edge: EdgeValues | None = None
        if body.modes.has_edge:
            series = None if len(self.factors) == 1 else (self.compliance, self.forces)
            self.edge = EdgeValues(body, self.factors, self.moves, series)

    def _put_in_series(self) -> None:
        body = self.body
        (a1, b1, c1), (a2, b2, c2) = (factors.pivot for factors in self.factors)
        b2 = -b2  # by the mirror
        # not compiled: with fused products, identical bodies would not decouple exactly
        det1 = a1 * c1 - b1 * b1
        det2 = a2 * c2 - b2 * b2
        det = det1 + det2 + a1 * c2 + a2 * c1 - 2.0 * (b1 * b2)
        self.modal = np.array([det2 * a1 + det1 * a2, det2 * b1 + det1 * b2]) / det
        self.compliance = np.array([c1 + c2, -(b1 + b2), a1 + a2]) / det
        xx, xy, yy = self.compliance
        products = []
        for a, b, c in ((a1, b1, c1), (a2, b2, c2)):
            products += [a * xx + b * xy, a * xy + b * yy, b * xx + c * xy, b * xy + c * yy]
        self.forces = np.array(products)
        self.by_slip = np.array([xx * a2 + xy * b2, xy * a2 + yy * b2])
        if not (body.modes.has_edge or body.is_held_along_y or self.moves):
            # the mean: both layers transmit the forces in balance, and do not move
            self.modal[:, 0] = 0.0
            self.compliance[:, 0] = 0.0
            self.forces[:, 0] = np.tile(0.5 * np.eye(2).ravel(), 2)
            self.by_slip[:, 0] = 0.5, 0.0

    def swept_down(self, load: Field, edge: Array) -> Array:
        """A load (N/m) swept down to the interface in each layer, with given edge values (m)."""
        swept = Field(np.empty_like(load.modes), edge)
        parts = zip(self.factors, self.body.parts(load), self.body.parts(swept), strict=True)
        for factors, own, part in parts:
            kernels.eliminate(
                factors.lower,
                own.modes,
                factors.profiles(part.edge),
                self.body.modes.edge_weights,
                self.body.modes.scale,
                part.modes,
            )
        return swept.modes

    def reduced(self, swept: Array) -> tuple[Array, Array | float]:
        """The load per mode that is held (N/m), and the interface's displacement (m), at w = 0.

        Of a pair: ``S2 T^-1 r1 - S1 T^-1 r2`` and ``T^-1 (r1 + r2)``.
        """
        if len(self.factors) == 1:
            return swept[0].copy(), 0.0
        x1, y1 = swept[0]
        x2, y2 = swept[self.body.layers[0].levels]
        y2 = -y2  # the lower body is mirrored
        xx1, xy1, yx1, yy1, xx2, xy2, yx2, yy2 = self.forces
        held_x = xx2 * x1 + xy2 * y1 - (xx1 * x2 + xy1 * y2)
        held_y = yx2 * x1 + yy2 * y1 - (yx1 * x2 + yy1 * y2)
        xx, xy, yy = self.compliance
        x = x1 + x2
        y = y1 + y2
        start_x = xx * x + xy * y
        start_y = xy * x + yy * y
        return np.array([held_x, held_y]), np.array([start_x, start_y])

    def substitute_up(
        self, swept: Array, amplitudes: Array, start: Array | float, before: Before | None = None
    ) -> Array:
        """Replace a swept load by the displacement (m), given w per mode and :meth:`reduced`.

        Returns the rate (m/s), zero if no displacements before are known.
        """
        parts = self.body.split(swept)
        parts[0][0] = start + self.by_slip * amplitudes
        for below in parts[1:]:
            below[0, 0] = parts[0][0, 0] - amplitudes
            below[0, 1] = -parts[0][0, 1]
        if before is None:
            for factors, part in zip(self.factors, parts, strict=True):
                factors.substitute(part)
            return np.zeros(swept.shape)  # faster: mostly nobody reads it
        rate = np.empty_like(swept)
        (c1, c2), beta, newest, oldest = before
        given = (newest.modes, oldest.modes, rate)
        for factors, *own in zip(self.factors, parts, *map(self.body.split, given), strict=True):
            part, u1, u2, own_rate = own
            kernels.move(factors.inverse, factors.lower, part, c1, c2, beta, u1, u2, own_rate)
        return rate

    def respond(self, load: Field, w: Array) -> Response:
        """The forces that hold the interface at w (m) under a load (N/m), the edge in balance."""
        amplitudes = self.body.modes.sine_amplitudes(w)
        nothing = np.zeros_like(load.edge)
        modes = self.swept_down(load, nothing)
        reduced, start = self.reduced(modes)
        tangential, normal = self.body.modes.forces(self.modal, amplitudes, reduced)
        if self.edge is None:
            return Response(w, tangential, normal, load, nothing)
        self.substitute_up(modes, amplitudes, start)
        residual = self.edge.residual(load, modes)
        edge = self.edge.compliance @ residual
        edge_kernels.add_edge(edge, self.edge.felt, tangential, normal)
        normal[-1] = self.edge.schur[0] @ edge - residual[0]
        return Response(w, tangential, normal, load, edge)

    def balance(
        self, response: Response, w: Array, before: Before | None = None
    ) -> tuple[Field, Field]:
        """The body for w (m) after a response: its displacement (m) and its velocity (m/s).

        The velocity follows from the step's formula; in statics it is zero.
        """
        edge = response.edge
        if self.edge is not None:
            near = self.edge.response_near
            change = w - response.w
            edge = edge + near @ change[-near.shape[1] :]
        modes = self.swept_down(response.load, edge)
        _, start = self.reduced(modes)
        amplitudes = self.body.modes.sine_amplitudes(w)
        rate = self.substitute_up(modes, amplitudes, start, before)
        edge_rate = np.zeros_like(edge)
        if before is not None:
            (c1, c2), beta, newest, oldest = before
            edge_rate = (edge - c1 * newest.edge - c2 * oldest.edge) / beta
        return Field(modes, edge), Field(rate, edge_rate)

    def apply(self, w: Array) -> Components:
        """``D w`` at the nodes 1..n_x and ``N w`` at 0..n_x (N/m), for w (m) at 1..n_x."""
        amplitudes = self.body.modes.sine_amplitudes(w)
        tangential, normal = self.body.modes.forces(self.modal, amplitudes, self._no_load)
        if self.edge is not None:
            edge_kernels.add_edge_in_balance(
                w, self.edge.felt, self.edge.response_near, self.edge.schur[0], tangential, normal
            )
        return tangential, normal

    @cached_property
    def _first_columns(self) -> tuple[Array, Array]:
        """Kernels d and h of D and N between nodes.

        In a block ``D_ij = d(i-j) - d(i+j)`` and ``N_ij = h(i+j) - h(i-j)``; both hold the
        arguments 0..2 n_x, d is even and h odd. In a period D and N are circulant.
        """
        modes = self.body.modes
        n = modes.n_x
        if self.edge is None:
            tangential, normal = self.apply(np.eye(n)[0])
            return tangential, normal[1:]
        d = fft.dct(self.modal[0]) / (2 * n)
        h = np.append(0.0, fft.dst(self.modal[1])) / (2 * n)
        # about the right edge i = n_x, the cosine modes are odd and the sine modes even
        d = np.concatenate((d, [0.0], -d[:0:-1], [-d[0]]))
        return d, np.concatenate((h, h[-2::-1]))

    @cached_property
    def diagonal(self) -> Array:
        """Diagonal of D (N/m per m) at the nodes 1..n_x."""
        d, _ = self._first_columns
        if self.edge is None:
            return np.full(d.size, d[0])
        of_modes = d[0] - d[2::2]
        of_modes[-1] *= 0.25
        return of_modes + self.edge.diagonal

    def tangent(self, nodes: NDArray[np.intp], dtype: type = float) -> Blocks:
        """Dense blocks of D and N (N/m per m) between some of the nodes 1..n_x, sorted."""
        key = (nodes.tobytes(), dtype)
        if key == self._last_key:  # mostly the same nodes slip in the next step
            return self._last_blocks
        blocks: NDArray = np.empty((2, nodes.size, nodes.size), dtype=dtype)
        stiffness, coupling = blocks
        self._last_key, self._last_blocks = key, (stiffness, coupling)
        d, h = self._first_columns
        edge = self.edge
        if edge is None:
            between = np.subtract.outer(nodes, nodes)
            blocks[:] = d[between], h[between]
            return self._last_blocks
        edge_kernels.interface_blocks(d, h, self.body.modes.n_x, nodes, stiffness, coupling)
        # the nodes that feel the right edge
        felt = np.abs(edge.diagonal) > EDGE_FELT * self.diagonal
        reach = int(np.argmax(felt)) + 1 if felt.any() else felt.size + 1
        near = int(np.searchsorted(nodes, reach))
        own = nodes[near:]
        if own.size:
            tangential, normal = edge.to_interface
            tangential = tangential[:, own - 1]
            response = edge.response[:, own - 1]
            stiffness[near:, near:] += tangential.T @ response
            coupling[near:, near:] += normal[:, own].T @ response
            if own[-1] == self.body.modes.n_x:
                coupling[-1, near:] += tangential[0]
        return self._last_blocks
