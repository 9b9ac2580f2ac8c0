"""The second body, below the interface: rigid as in the paper's simulations, or another block."""

import dataclasses

from .checked import Checked
from .quantities import ParameterError, declarations, quantity

BOTTOMS = ("free", "clamped", "roller")


@dataclasses.dataclass(frozen=True)
class SecondBody(Checked):
    """The body below the interface; a deformable one has the first block's value where None.

    Raises
    ------
    ParameterError
        Also if a rigid body has properties that only a deformable one can have.

    Examples
    --------
    >>> SecondBody(kind="deformable", shear_modulus=60e9, poisson_ratio=0.3).deformable
    True
    """

    kind: str = quantity(
        "body below the interface: a rigid base, or a second deformable block",
        choices=("rigid", "deformable"),
        default="rigid",
    )
    far_side: str | None = quantity(
        "far side of the second block: free under the normal stress, clamped, or on rollers that "
        "hold it along y; free if left out",
        choices=BOTTOMS,
        default=None,
    )
    shear_modulus: float | None = quantity(
        "shear modulus of the second block; the first one's if left out",
        "(0.0, 1e13) Pa",
        symbol="mu2",
        default=None,
    )
    poisson_ratio: float | None = quantity(
        "Poisson's ratio of the second block; the first one's if left out",
        "(-1.0, 0.5)",
        symbol="nu2",
        default=None,
    )
    density: float | None = quantity(
        "mass density of the second block, zero: without inertia; the first one's if left out",
        "[0.0, 1e6) kg/m^3",
        symbol="rho2",
        default=None,
    )
    height: float | None = quantity(
        "height of the second block; the first one's if left out",
        "(0.0, 1e6) m",
        symbol="H2",
        default=None,
    )
    n_y: int | None = quantity(
        "number of elements along y of the second block; the first one's if left out",
        "[2, 10000]",
        default=None,
    )
    grading: float | None = quantity(
        "height of the bottom row of elements of the second block over that of the row at the "
        "interface; the first one's grading if left out",
        "[1.0, 1000.0]",
        default=None,
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.deformable:
            return
        for name, entry in declarations(SecondBody).items():
            value = getattr(self, name)
            if name != "kind" and value is not None:
                raise ParameterError(
                    f"second_body.{name} = {value!r}{entry.unit_suffix} is not allowed with "
                    "second_body.kind = rigid, a base that does not deform: leave "
                    f"{name} out, or make kind deformable"
                )

    @property
    def deformable(self) -> bool:
        """Whether the second body is a deformable block."""
        return self.kind == "deformable"
