"""The block of a simulation along x, and its finite-element mesh."""

import dataclasses
from typing import ClassVar

from .checked import Checked
from .quantities import quantity


@dataclasses.dataclass(frozen=True)
class Block(Checked):
    """Length of the bodies and numbers of bilinear elements; the fault has their heights."""

    called: ClassVar = {"length": "block_length"}

    length: float = quantity("block length", "(0.0, 1e7) m", symbol="L", default=1.0)
    n_x: int = quantity("number of elements along x", "[8, 100000]", symbol="N_x", default=400)
    n_y: int = quantity("number of elements along y", "[2, 10000]", symbol="N_y", default=150)
    grading: float = quantity(
        "height of the top row of elements over that of the bottom row",
        "[1.0, 1000.0]",
        default=1.0,
    )
    second_n_y: int | None = quantity(
        "number of elements along y of the second block; the first one's if left out",
        "[2, 10000]",
        default=None,
    )
    second_grading: float | None = quantity(
        "height of the bottom row of elements of the second block over that of the row at the "
        "interface; the first one's grading if left out",
        "[1.0, 1000.0]",
        default=None,
    )
