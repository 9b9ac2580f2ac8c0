"""The stress due to slip of a patch between given bodies, in the modes of :mod:`.modes`."""

import dataclasses

import numpy as np

from ...types import Array
from ..spectrum import Systems
from .modes import CUT, Modes, mirror_modes

MODES = 16  # of slip: enough for an error of L_s of some 1e-4
MORE_MODES = 32
"""Number of modes where the stiffer body is above: pushed that way, slip increases the compression
behind the front (:func:`modes_for`)."""

STIFFER_ABOVE = -0.05  # f G2/G1 of the half-spaces below which there are more modes
REACHES = (5.0, 25.0, 250.0)
"""Patch lengths over height for which there are tables: thicker layers need shorter ones; those
thinner than the last are extrapolated."""

SLIMMEST = REACHES[-1]
EXTRAPOLATED = 1e-3  # error of L_s of the slimmest layers, against their limit (:mod:`.thin`)
ROUNDING = 1.0 + 1e-9  # of a ratio that is compared with REACHES


@dataclasses.dataclass(frozen=True)
class PatchResponse:
    """Stress over sigma0 at theta by slip over D in each mode, (N, N + 1)."""

    modes: Modes
    length: float  # L (m)
    shear: Array  # shear stress that the interface loses
    normal: Array  # compression that it gains

    def coupled(self, friction: Array | float) -> Array:
        """Shear stress lost plus friction that is gained: ``K1 + f S2``."""
        return self.shear + np.reshape(friction, (-1, 1)) * self.normal


def modes_for(one: Systems) -> int:
    """Number of modes that one fault needs."""
    g1, g2 = _half_space_functions(one)
    coupling = float(one.friction[0]) * float(g2[0] / g1[0])
    return MORE_MODES if coupling < STIFFER_ABOVE else MODES


def response(
    one: Systems,
    length: float,
    number: int = MODES,
    loading: str = "edge",
) -> PatchResponse:
    """The response of one fault's bodies to slip of a patch.

    Takes length (m). Returns: Column 0 is for the imposed quantity: the edge's displacement, or
    under a remote load a shear stress of sigma0 on all of the interface.
    """
    if loading == "edge":
        return _mirror_response(one, length, number, even=False)
    odd = _mirror_response(one, 0.5 * length, number, even=False)
    even = _mirror_response(one, 0.5 * length, number, even=True)
    one_side = odd.modes.theta
    modes = Modes(
        theta=np.append(one_side, np.pi - one_side),
        values=_on_both_sides(odd.modes.values, even.modes.values, 1.0),
        smoothing=np.append(odd.modes.smoothing, even.modes.smoothing[1:]),
    )
    return PatchResponse(
        modes=modes,
        length=length,
        shear=_on_both_sides(odd.shear, even.shear, 1.0, imposed=-1.0),
        normal=_on_both_sides(odd.normal, even.normal, -1.0),
    )


def _on_both_sides(
    odd: Array,
    even: Array,
    sign: float,
    imposed: float = 0.0,
) -> Array:
    """Columns of both symmetries at x > 0, continued to x < 0; `sign` is that of even columns."""
    odd, even = odd[:, 1:], even[:, 1:]
    columns = np.block([[odd, even], [-sign * odd, sign * even]])
    return np.insert(columns, 0, imposed, axis=1)


def _slimness(
    one: Systems,
    length: float,
) -> float:
    """Patch length (m) over the height of the lower of the bodies."""
    return length / min(float(body.height[0]) for body in one.pair.deformable)


def _half_space_functions(one: Systems) -> tuple[Array, Array]:
    """G1 and G2 of half-spaces of the same materials, for k > 0."""
    return _with_heights_times(one, np.inf).pair.transfer_functions(np.ones(1))


def _mirror_response(
    one: Systems,
    length: float,
    number: int,
    even: bool,
) -> PatchResponse:
    """The response in the modes of one symmetry about x = 0, at x > 0.

    A layer that is slimmer than the tables reach is extrapolated, linearly in H/L, from the
    slimmest one with tables and one twice as high.
    """
    slim = _slimness(one, length)
    if slim <= SLIMMEST:
        return _resolved(one, length, number, even)
    first = _thickened(one, length, number, even, slim / SLIMMEST)
    second = _thickened(one, length, number, even, slim / (0.5 * SLIMMEST))
    beyond = SLIMMEST / slim - 1.0
    return dataclasses.replace(
        first,
        shear=first.shear + beyond * (second.shear - first.shear),
        normal=first.normal + beyond * (second.normal - first.normal),
    )


def extrapolation_error(
    one: Systems,
    length: float,
) -> float:
    """Upper bound of the error of L_s due to layers slimmer than the tables reach.

    Takes length (m). Returns: Relative error of L_s.
    """
    slim = _slimness(one, length)
    return EXTRAPOLATED * (1.0 - SLIMMEST / slim) if slim > SLIMMEST else 0.0


def _resolved(
    one: Systems,
    length: float,
    number: int,
    even: bool,
) -> PatchResponse:
    """The same of layers that are not slimmer than the tables reach.

    A slimmer zone beside the fault is replaced by a thicker one that resists long waves alike.
    """
    one = one._replace(pair=one.pair.with_zones_at_least(length / SLIMMEST))
    slim = length / min(float(thickness[0]) for thickness in one.pair.thicknesses)
    reach = min(reach for reach in REACHES if slim <= reach * ROUNDING)
    modes = mirror_modes(number, reach, even)
    used = np.searchsorted(modes.kappa, CUT * slim)
    far_g1, far_g2 = _half_space_functions(one)
    g1, g2 = one.pair.transfer_functions(modes.kappa[:used] / length)
    slip = modes.slip[:used]
    more_g1 = (g1 - far_g1)[:, None]
    more_g2 = (g2 - far_g2)[:, None]
    more_shear = modes.shear[:used].T @ (more_g1 * slip)
    more_normal = modes.normal[:used].T @ (more_g2 * slip)
    scale = float(one.softness[0]) / length
    return PatchResponse(
        modes=modes,
        length=length,
        shear=scale * (far_g1 * modes.half_space + more_shear),
        normal=scale * (far_g2 * modes.gradients + more_normal),
    )


def _thickened(
    one: Systems,
    length: float,
    number: int,
    even: bool,
    factor: float,
) -> PatchResponse:
    """The response of layers made thicker by a factor, corrected by the ratio of G at ``kL = pi``.

    Where ``kH`` is small G1 and G2 are powers of k, and thickness only scales them.
    """
    thicker = _with_heights_times(one, factor)
    k = np.array([np.pi / length])
    g1, g2 = one.pair.transfer_functions(k)
    thick_g1, thick_g2 = thicker.pair.transfer_functions(k)
    with np.errstate(divide="ignore", invalid="ignore"):
        by_shear = float(g1[0] / thick_g1[0])
        by_normal = float(g2[0] / thick_g2[0])
    if not np.isfinite(by_normal):
        by_normal = 0.0
    found = _resolved(thicker, length, number, even)
    return dataclasses.replace(
        found,
        shear=by_shear * found.shear,
        normal=by_normal * found.normal,
    )


def _with_heights_times(
    one: Systems,
    factor: float,
) -> Systems:
    """The system with all heights multiplied."""
    return one._replace(pair=one.pair.with_heights(lambda height: factor * height))
