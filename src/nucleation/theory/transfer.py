"""Quasi-static response of elastic bodies to a Fourier mode of interfacial slip (Text S1.1).

All fields vary as ``exp(Lambda t - i k x)``. The upper body (1) occupies ``0 < y < H1``, the lower
body (2) ``-H2 < y < 0``; in plane stress ``nu/(1 + nu)`` replaces nu. One body responds to
tractions by ``du_i = M_ij dsigma_yj``, and a pair of bodies that slides without opening by

    dsigma_xy = -mu k G1 deps,    dsigma_yy = i mu k G2 deps .

Each body is a stiffness matrix A that depends on ``q = |k| H`` alone (:mod:`.stiffness`), with the
lower body mirrored: ``-A_xy`` changes sign. In ``G = (M1 - M2)^-1`` the stiffnesses act in series.
For 2x2 matrices there is a form without a subtraction in the diagonal entries,

    (A^-1 + B^-1)^-1 = (det(B) A + det(A) B) / det(A + B) .

So the result is accurate also where M is singular (a free body translates as a whole for Hk -> 0)
or where the pair is ill-conditioned.
"""

import dataclasses
import math

import numpy as np
from numpy.typing import ArrayLike

from ..model.checked import Checked
from ..model.material import ANTIPLANE, Material
from ..model.parameters import Parameters
from ..model.quantities import quantity
from .stiffness import FAR_SIDES, Array, LayerPair, Layers, require_far_side


@dataclasses.dataclass(frozen=True)
class Body(Checked):
    """An elastic body, infinite along x, on one side of the interface (SI units)."""

    material: Material = Material()
    height: float = quantity(
        "height of the body (inf: half-space)",
        unit="m",
        low=0.0,
        high=math.inf,
        closed="high",
        symbol="H",
        default=math.inf,
    )
    far_side: str = quantity(
        "condition on the side away from the interface: velocity (u_x and sigma_yy imposed), "
        "traction or free (sigma_xy and sigma_yy imposed), clamped (u_x and u_y imposed) or "
        "roller (u_y and sigma_xy imposed)",
        choices=tuple(FAR_SIDES),
        default="velocity",
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        require_far_side("far_side", self.far_side, self.material.plane)

    @property
    def layers(self) -> Layers:
        """The body as one layer."""
        material = self.material
        return Layers(
            shear_modulus=np.asarray(material.shear_modulus),
            poisson_ratio=np.asarray(material.in_plane_ratio),
            height=np.asarray(self.height),
            far_side=self.far_side,
            antiplane=material.plane == ANTIPLANE,
        )


@dataclasses.dataclass(frozen=True)
class RigidBody:
    """A body that does not deform (``M = 0``)."""

    @property
    def layers(self) -> None:
        """None, as in :class:`~nucleation.theory.stiffness.LayerPair`."""


RIGID = RigidBody()


def bodies_of(parameters: Parameters) -> tuple[Body, Body | RigidBody]:
    """The upper and the lower body of a run, with the far sides that follow from its loading."""
    far_side = "velocity" if parameters.loading.kind == "top" else "free"
    upper = Body(parameters.material, parameters.geometry.height, far_side)
    below = parameters.below
    if below is None:
        return upper, RIGID
    return upper, Body(below.material, below.geometry.height, below.far_side)


def as_wavenumber(wavenumber: ArrayLike) -> Array:
    """The wavenumber as a float array; raises ValueError unless it is finite and not zero."""
    k = np.asarray(wavenumber, dtype=float)
    if not np.all(np.isfinite(k) & (k != 0.0)):
        raise ValueError("the wavenumber k (1/m) must be finite and different from zero")
    return k


def transfer_functions(
    wavenumber: ArrayLike,
    upper: Body | RigidBody,
    lower: Body | RigidBody,
) -> tuple[Array, Array]:
    """G1 and G2 of a pair of bodies.

    Parameters
    ----------
    wavenumber : array_like
        k (1/m), of either sign and not zero.
    upper, lower : Body or RigidBody
        The two bodies, at most one of them rigid.

    Returns
    -------
    G1, G2 : ndarray
        Dimensionless, shape of k; G1 is odd and G2 even in it.

    Raises
    ------
    ValueError
        If a wavenumber is zero or not finite, or both bodies are rigid.

    Notes
    -----
    ``G1 = -G_xx/(mu k)`` and ``G2 = -i G_yx/(mu k)`` with ``G = (M1 - M2)^-1`` (Eqs. S-defG and
    S-sig_G) and mu of the upper body, or of the lower one if the upper one is rigid.
    """
    pair = LayerPair(upper.layers, lower.layers)
    k = as_wavenumber(wavenumber)
    return pair.transfer_functions(k)
