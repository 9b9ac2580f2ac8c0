"""A pair of blocks by its assembled sparse matrix, for comparison with the separable solver."""

import numpy as np
from fem.assembled_problem import AssembledBlock, nodal_forces
from scipy import sparse
from scipy.sparse.linalg import splu

HELD = {"free": (), "clamped": ("x", "y"), "roller": ("y",)}


class AssembledPair:
    """All nodes of both blocks; those of the interface are in both, tied by slip and no opening.

    The lower block is assembled upside down, on a grid that goes up from the interface, and its
    u_y is turned round.
    """

    def __init__(self, upper, lower, bottom):
        """`upper` and `lower` are (grid, material)."""
        self.upper, self.lower = AssembledBlock(*upper), AssembledBlock(*lower)
        n, n_lower = self.upper.stiffness.shape[0], self.lower.stiffness.shape[0]
        turned = np.ones(n_lower)
        turned[self.lower.y] = -1.0
        turn = sparse.diags(turned)
        self.stiffness, self.mass = (
            sparse.block_diag((one, turn @ other @ turn)).tocsr()
            for one, other in (
                (self.upper.stiffness, self.lower.stiffness),
                (self.upper.mass, self.lower.mass),
            )
        )
        self.x, self.y = self.upper.x, self.upper.y  # numbers of the unknowns, levels from y = 0
        self.below_x, self.below_y = self.lower.x + n, self.lower.y + n
        fixed = np.zeros(n + n_lower, dtype=bool)
        fixed[self.x[:, 0]] = fixed[self.below_x[:, 0]] = True
        if "x" in HELD[bottom]:
            fixed[self.below_x[-1]] = True
        if "y" in HELD[bottom]:
            fixed[self.below_y[-1]] = True
        # the lower block's nodes on the interface follow those of the upper one
        follows = np.arange(n + n_lower)
        follows[self.below_x[0, 1:]], follows[self.below_y[0]] = self.x[0, 1:], self.y[0]
        own = np.flatnonzero(~fixed & (follows == np.arange(n + n_lower)))
        column = np.full(n + n_lower, -1)
        column[own] = np.arange(own.size)
        rows = np.flatnonzero(column[follows] >= 0)
        self.tie = sparse.csr_matrix(
            (np.ones(rows.size), (rows, column[follows[rows]])), shape=(n + n_lower, own.size)
        )
        self.corner = column[self.y[0, -1]]

    def forces(self, body, load):
        """Nodal forces whose generalised forces per mode are those of a load of the pair."""
        forces = np.zeros(self.stiffness.shape[0])
        parts = body.parts(load)
        places = ((self.x, self.y, 1.0), (self.below_x, self.below_y, -1.0))
        for part, (x, y, sign) in zip(parts, places, strict=True):
            tangential, normal = nodal_forces(body.modes, part.modes)
            forces[x[:, 1:]], forces[y] = tangential, sign * normal
            forces[y[:, -1]] = sign * part.edge
        return forces

    def values(self, body, field):
        """The unknowns of a field of the pair."""
        values = np.zeros(self.stiffness.shape[0])
        values[self.x], values[self.y] = body.nodal_values(field)
        values[self.below_x], values[self.below_y] = body.nodal_values(field, 1)
        return values

    def solve(self, s, forces, w, pinned=False):
        """All unknowns at a slip `w`, and the forces left; `pinned`: the corner stays."""
        matrix = (self.stiffness + s * self.mass).tocsr()
        slipped = np.zeros(matrix.shape[0])
        slipped[self.below_x[0, 1:]] = -w
        tie = self.tie
        if pinned:
            tie = tie[:, np.delete(np.arange(tie.shape[1]), self.corner)]
        z = splu((tie.T @ matrix @ tie).tocsc()).solve(tie.T @ (forces - matrix @ slipped))
        u = tie @ z + slipped
        return u, matrix @ u - forces
