"""A body by its assembled sparse matrix, for comparison with the separable solver."""

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import splu

from benchmarks.assembled import assemble, unknown
from benchmarks.nodal import nodal_values

HELD = {"free": (), "clamped": (0, 1), "roller": (1,)}


class Assembled:
    """All nodes of one block or two, or of one period, whose last nodes along x are its first.

    Nodes of the interface are in both blocks, tied by slip and no opening; those of one block are
    held on the base. The lower block goes up from the interface, and its u_y is turned round.
    `places` are the unknowns u_x and u_y at the nodes of each block, and the sign of u_y.
    """

    def __init__(self, body, bottom="free"):
        self.body, self.places, fixed, follows = body, [], [], []
        matrices, n = [], 0
        for layer, sign in zip(body.layers, (1.0, -1.0), strict=False):
            grid = layer.grid
            i, j = np.meshgrid(np.arange(grid.n_x + 1), np.arange(grid.n_y + 1))
            within = i % grid.n_x if grid.periodic else i
            parts = assemble(grid, layer.material)
            turned, onto = np.ones(parts[0].shape[0]), np.arange(parts[0].shape[0])
            for component in (0, 1):
                onto[unknown(grid, i, j, component)] = unknown(grid, within, j, component)
            x, y = (unknown(grid, within, j, component) for component in (0, 1))
            turned[unknown(grid, i, j, 1)] = sign
            turn = sparse.csr_array((turned, (np.arange(onto.size), onto)), 2 * onto.shape)
            matrices.append([turn.T @ part @ turn for part in parts])
            own = onto != np.arange(onto.size)
            if not grid.periodic:
                own[x[:, 0]] = True
            self.places.append((x + n, y + n, sign))
            fixed.append(own)
            n += onto.size
        self.stiffness, self.mass = map(sparse.block_diag, zip(*matrices, strict=True))
        fixed, follows = np.concatenate(fixed), np.arange(n)
        (x, y, _), below = self.places[0], self.places[-1]
        if len(self.places) == 1:
            fixed[x[0]] = fixed[y[0]] = True
        else:
            for component in HELD[bottom]:
                fixed[below[component][-1]] = True
            follows[below[0][0]], follows[below[1][0]] = x[0], y[0]
        own = np.flatnonzero(~fixed & (follows == np.arange(n)))
        column = np.full(n, -1)
        column[own] = np.arange(own.size)
        rows = np.flatnonzero(column[follows] >= 0)
        entries = np.ones(rows.size), (rows, column[follows[rows]])
        self.tie = sparse.csr_array(entries, (n, own.size))
        self.corner = column[y[0, -1]]

    def forces(self, load):
        """Nodal forces (N/m) whose generalised forces per mode are those of a load."""
        forces, modes = np.zeros(self.stiffness.shape[0]), self.body.modes
        one, nothing = np.ones(modes.n_x), np.zeros((2, modes.n_x))
        for part, (x, y, sign) in zip(self.body.parts(load), self.places, strict=True):
            for level, amplitudes in enumerate(part.modes):
                tangential, normal = modes.forces(amplitudes, one, nothing)
                forces[x[level, 1:]], forces[y[level]] = tangential, sign * normal
            if modes.has_edge:
                forces[y[:, -1]] = sign * part.edge
        return forces

    def values(self, field):
        """The unknowns of a field."""
        values = np.zeros(self.stiffness.shape[0])
        for number, (x, y, _) in enumerate(self.places):
            values[x], values[y] = nodal_values(self.body, field, number)
        return values

    def solve(self, s, forces, w, pinned=False):
        """All unknowns at a slip `w`, and the forces left; `pinned`: the corner stays."""
        matrix = (self.stiffness + s * self.mass).tocsr()
        slipped = np.zeros(matrix.shape[0])
        slipped[self.places[-1][0][0, 1:]] = w if len(self.places) == 1 else -w
        tie = self.tie
        if pinned:
            tie = tie[:, np.delete(np.arange(tie.shape[1]), self.corner)]
        z = splu((tie.T @ matrix @ tie).tocsc()).solve(tie.T @ (forces - matrix @ slipped))
        u = tie @ z + slipped
        return u, matrix @ u - forces
