"""Heterogeneity: one property of the interface that varies along x, as declared data.

    q(x) = q [1 + change h(x)],   step: h = 1 for |x - centre| <= width/2, 0 elsewhere
                                  bump: h = exp(-4 log(2) (x - centre)^2/width^2)

So `width` is that of the step, or of the bump at half its height. The properties are the normal
stress at the interface, beside what slip changes of it; D; and f, a, b and zeta = b - a of sliding
at V, for which the friction law's own parameters are found at each node (``with_expansion``). With
a change below -1 zeta has one sign within and the other one elsewhere: a patch that weakens among
surroundings that strengthen.
"""

import copy
import dataclasses

import numpy as np

from ..types import Array
from .checked import Checked
from .friction.law import Friction
from .quantities import ParameterError, quantity


@dataclasses.dataclass(frozen=True)
class Heterogeneity(Checked):
    """What varies along the interface; by default nothing does.

    Raises
    ------
    ParameterError
        Also if something is to vary by nothing, or nothing by something, or if the change takes a
        positive property below zero.
    """

    varies: str = quantity(
        "property of the interface that varies along x; a changes at fixed b, and b at fixed a",
        choices=("none", "normal_stress", "f", "a", "b", "zeta", "slip_distance"), default="none",
    )  # fmt: skip
    shape: str = quantity("how it varies along x", choices=("step", "bump"), default="bump")
    centre: float | None = quantity(
        "position of the step's or the bump's middle; the block's middle if left out",
        unit="m", low=0.0, high=1e7, closed="low", default=None,
    )  # fmt: skip
    width: float = quantity(
        "width of the step, or of the bump at half its height", unit="m", low=0.0, high=1e7,
        default=0.1,
    )  # fmt: skip
    change: float = quantity(
        "change of the property within, over its value elsewhere; below -1 for zeta alone, which "
        "changes its sign there",
        low=-1e3,
        high=1e3,
        default=0.0,
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        if (self.varies == "none") != (self.change == 0.0):
            rule = "0" if self.varies == "none" else "different from 0"
            raise ParameterError(
                f"heterogeneity.change = {self.change:g} is not allowed with heterogeneity.varies "
                f"= {self.varies}: it must be {rule}"
            )
        if self.change <= -1.0 and self.varies != "zeta":
            raise ParameterError(
                f"heterogeneity.change = {self.change:g} is not allowed with heterogeneity.varies "
                f"= {self.varies}, which is positive everywhere: it must lie in (-1, 1000)"
            )

    def factor(self, x: Array, length: float, periodic: bool) -> Array:
        """``1 + change h(x)`` at positions (m) on an interface of a length (m)."""
        away = x - (0.5 * length if self.centre is None else self.centre)
        if periodic:
            away = away - length * np.round(away / length)
        if self.shape == "step":
            h = (np.abs(away) <= 0.5 * self.width).astype(float)
        else:
            h = np.exp(-4.0 * np.log(2.0) * (away / self.width) ** 2)
        return 1.0 + self.change * h

    def friction(self, law: Friction, velocity: float, factor: Array) -> Friction:
        """The law whose parameters are arrays along x where they vary, by :meth:`factor`.

        Parameters
        ----------
        law : elsewhere.
        velocity : V (m/s), at which f, a and zeta are meant.
        factor : (nodes,).

        Raises
        ------
        ParameterError
            If the law has no parameters for the values somewhere.
        """
        if self.varies in ("none", "normal_stress"):
            return law
        if self.varies == "slip_distance":
            values = {"characteristic_slip_distance": law.characteristic_slip_distance * factor}
        else:
            each, nodes = np.unique(factor, return_inverse=True)
            laws = [self._local(law, velocity, float(one)) for one in each]
            values = {
                name: np.array([getattr(own, name) for own in laws])[nodes]
                for name in law.set_by_expansion
            }
        varied = copy.copy(law)
        for name, along_x in values.items():
            object.__setattr__(varied, name, along_x)  # frozen, and checked place by place
        return varied

    def _local(self, law: Friction, velocity: float, factor: float) -> Friction:
        """The law at a place."""
        if factor == 1.0:
            return law
        f, a, zeta = law.expansion(velocity)
        own = {"f": f, "a": a, "b": a + zeta, "zeta": zeta}
        own[self.varies] *= factor
        if self.varies in ("a", "b"):
            own["zeta"] = own["b"] - own["a"]
        try:
            return law.with_expansion(velocity, own["f"], own["a"], own["zeta"])
        except ParameterError as error:
            raise ParameterError(
                f"heterogeneity.change = {self.change:g} is not allowed: {self.varies} = "
                f"{own[self.varies]:.4g} somewhere, and {error}"
            ) from None
