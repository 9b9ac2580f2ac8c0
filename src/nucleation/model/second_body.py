"""The second body, below the interface: rigid as in the paper's simulations, or another block."""

import dataclasses

from .checked import Checked
from .quantities import ParameterError, declarations, quantity

BOTTOMS = ("free", "clamped", "roller")


@dataclasses.dataclass(frozen=True)
class SecondBody(Checked):
    """What the block slides on; a deformable one is like the block in all that is left out.

    Raises
    ------
    ParameterError
        Also if a rigid body is given properties that only a deformable one has.
    """

    kind: str = quantity(
        "what the block slides on: a rigid base, or a second deformable block",
        choices=("rigid", "deformable"), default="rigid",
    )  # fmt: skip
    bottom: str | None = quantity(
        "far side of the second block: free under the normal stress, clamped, or on rollers that "
        "hold it along y; free if left out",
        choices=BOTTOMS, default=None,
    )  # fmt: skip
    shear_modulus: float | None = quantity(
        "shear modulus of the second block; the first one's if left out",
        unit="Pa", low=0.0, high=1e13, symbol="mu2", default=None,
    )  # fmt: skip
    poisson_ratio: float | None = quantity(
        "Poisson's ratio of the second block; the first one's if left out",
        low=-1.0, high=0.5, symbol="nu2", default=None,
    )  # fmt: skip
    density: float | None = quantity(
        "mass density of the second block, zero: without inertia; the first one's if left out",
        unit="kg/m^3", low=0.0, high=1e6, closed="low", symbol="rho2", default=None,
    )  # fmt: skip
    height: float | None = quantity(
        "height of the second block; the first one's if left out",
        unit="m", low=0.0, high=1e6, symbol="H2", default=None,
    )  # fmt: skip
    n_y: int | None = quantity(
        "number of elements along y of the second block; the first one's if left out",
        low=2, high=10000, closed="both", default=None,
    )  # fmt: skip
    grading: float | None = quantity(
        "height of the bottom row of elements of the second block over that of the row at the "
        "interface; the first one's grading if left out",
        low=1.0, high=1000.0, closed="both", default=None,
    )  # fmt: skip

    def __post_init__(self) -> None:
        super().__post_init__()
        for name, entry in declarations(SecondBody).items():
            value = getattr(self, name)
            if not self.deformable and name != "kind" and value is not None:
                unit = "" if entry.unit == "1" else f" {entry.unit}"
                raise ParameterError(
                    f"second_body.{name} = {value!r}{unit} is not allowed with second_body.kind = "
                    f"rigid, a base that does not deform: leave {name} out, or make kind deformable"
                )

    @property
    def deformable(self) -> bool:
        """Whether it is a second block."""
        return self.kind == "deformable"
