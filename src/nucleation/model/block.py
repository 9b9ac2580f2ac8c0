"""The deformable block and its finite-element mesh."""

import dataclasses

from .checked import Checked
from .quantities import quantity


@dataclasses.dataclass(frozen=True)
class Geometry(Checked):
    """The deformable block ``0 <= x <= length``, ``0 <= y <= height``.

    Examples
    --------
    >>> Geometry(height=0.01, length=1.0).height
    0.01
    """

    height: float = quantity("block height", "(0.0, 1e6) m", symbol="H", default=0.005)
    length: float = quantity("block length", "(0.0, 1e7) m", symbol="L", default=1.0)


@dataclasses.dataclass(frozen=True)
class Mesh(Checked):
    """The structured finite-element mesh: numbers of bilinear elements and grading in y.

    Examples
    --------
    >>> mesh = Mesh(n_x=200, n_y=10)
    >>> mesh.n_x * mesh.n_y
    2000
    """

    n_x: int = quantity("number of elements along x", "[8, 100000]", symbol="N_x", default=400)
    n_y: int = quantity("number of elements along y", "[2, 10000]", symbol="N_y", default=150)
    grading: float = quantity(
        "height of the top row of elements over that of the bottom row",
        "[1.0, 1000.0]",
        default=1.0,
    )
