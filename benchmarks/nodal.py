"""Nodal displacements of a body, by the sums over its modes."""

from __future__ import annotations

import numpy as np

from nucleation.fem.body import Body
from nucleation.fem.grid import Components, Field


def nodal_values(body: Body, field: Field, number: int = 0) -> Components:
    """Nodal w_x and u_y of a layer, by its number, levels from the interface on.

    Each has the shape (n_y + 1, n_x + 1).
    """
    own = body.parts(field)[number]
    n = body.modes.n_x
    along_x, along_y = own.modes[:, 0], own.modes[:, 1]
    nodes = np.arange(n + 1)
    if body.modes.has_edge:
        angle = np.outer(np.arange(n) + 0.5, nodes) * np.pi / n
        x, y = along_x @ np.sin(angle), along_y @ np.cos(angle)
        y[:, -1] = own.edge
        return x, -y if number else y
    half = n // 2
    angle = np.outer(np.arange(1, half + 1), nodes - 1) * 2.0 * np.pi / n  # from node 1 on
    waves = np.concatenate((np.ones((1, n + 1)), np.sin(angle), np.cos(angle)))
    shifted = np.concatenate((np.ones((1, n + 1)), np.cos(angle), -np.sin(angle)))
    x, y = along_x @ waves, along_y @ shifted
    return x, -y if number else y
