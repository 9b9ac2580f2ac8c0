"""Heterogeneity: one property of the interface that varies along x, as declared data.

    q(x) = q [1 + change h(x)],   step: h = 1 for |x - centre| <= width/2, 0 elsewhere
                                  bump: h = exp(-4 log(2) (x - centre)^2/width^2)

So `width` is the width of the step, or of the bump at half its height. The properties are the
normal stress at the interface, without the changes that slip causes; D; and f, a, b and
zeta = b - a of sliding at V. For these the friction law's own parameters are determined at each
node (``with_expansion``). With a change below -1, zeta has one sign within and the other one
elsewhere: a weakening patch in surroundings that strengthen.
"""

import dataclasses

import numpy as np

from ..types import Array
from .friction import Friction
from .quantities import ParameterError, quantity
from .units import Checked


@dataclasses.dataclass(frozen=True)
class Heterogeneity(Checked):
    """The property that varies along the interface; by default none.

    A ParameterError refuses a varying property with the change zero, a change without a property,
    and one that makes a positive property negative.
    """

    varies: str = quantity(
        "property of the interface that varies along x; a changes at fixed b, and b at fixed a",
        choices=("none", "normal_stress", "friction", "a", "b", "zeta", "slip_distance"),
        name="heterogeneity",
        default="none",
    )
    shape: str = quantity(
        "shape of the variation along x", choices=("step", "bump"), default="bump"
    )
    centre: float | None = quantity(
        "position of the step's or the bump's middle; the block's middle if left out",
        "[0.0, 1e7) m",
        default=None,
    )
    width: float = quantity(
        "width of the step, or of the bump at half its height", "(0.0, 1e7) m", default=0.1
    )
    change: float = quantity(
        "change of the property within, over its value elsewhere; below -1 for zeta alone, which "
        "changes its sign there",
        "(-1e3, 1e3)",
        default=0.0,
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        uniform = self.varies == "none"
        clash = f"change = {self.change:g} is not allowed with heterogeneity = {self.varies}"
        if uniform != (self.change == 0.0):
            rule = "0" if uniform else "different from 0"
            raise ParameterError(f"{clash}: it must be {rule}")
        if self.change <= -1.0 and self.varies != "zeta":
            raise ParameterError(
                f"{clash}, which is positive everywhere: it must lie in (-1, 1000)"
            )

    def factor(self, x: Array, length: float, periodic: bool) -> Array:
        """The property over its value elsewhere, ``1 + change h(x)``, at positions x (m).

        The interface has a length (m), and may be periodic along x.
        """
        distance = x - (0.5 * length if self.centre is None else self.centre)
        if periodic:
            distance = distance - length * np.round(distance / length)
        if self.shape == "step":
            h = (np.abs(distance) <= 0.5 * self.width).astype(float)
        else:
            h = np.exp(-4.0 * np.log(2.0) * (distance / self.width) ** 2)
        return 1.0 + self.change * h

    def friction(self, law: Friction, velocity: float, factor: Array) -> Friction:
        """The friction law along x, from the law outside, V (m/s) and the factors of the nodes.

        Parameters that vary are arrays of the nodes. Raises a ParameterError if the law has no
        allowed parameters for the values at a node.
        """
        if self.varies in ("none", "normal_stress"):
            return law
        if self.varies == "slip_distance":
            values = {"slip_distance": law.slip_distance * factor}
        else:
            distinct, nodes = np.unique(factor, return_inverse=True)
            laws = [self._local_law(law, velocity, float(one)) for one in distinct]
            values = {}
            for name in law.set_by_expansion:
                local = np.array([getattr(own, name) for own in laws])
                values[name] = local[nodes]
        return law.along_x(**values)

    def _local_law(self, law: Friction, velocity: float, factor: float) -> Friction:
        if factor == 1.0:
            return law
        f, a, zeta = law.expansion(velocity)
        own = {"friction": f, "a": a, "b": a + zeta, "zeta": zeta}
        own[self.varies] *= factor
        if self.varies in ("a", "b"):
            own["zeta"] = own["b"] - own["a"]
        try:
            return law.with_expansion(velocity, own["friction"], own["a"], own["zeta"])
        except ParameterError as error:
            raise ParameterError(
                f"change = {self.change:g} is not allowed: {self.varies} = "
                f"{own[self.varies]:.4g} somewhere, and {error}"
            ) from None
