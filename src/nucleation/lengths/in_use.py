"""The nucleation lengths in use, each with formula, source and validity in words.

Their common definitions are in :mod:`nucleation.lengths.formulas`.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from operator import methodcaller

import numpy as np

from ..theory.values import FaultLike, Numbers, Values, checked, where
from . import formulas
from .finite_patch import NEAREST, loaded_patch_factor
from .formulas import HALF_SPACES, RIGID_BASE, Length, Setting, nan0, valid
from .ranges import WEAKENING_RATE


def _crack(s: Setting) -> Numbers:
    weakening = (s.b - s.a) / nan0(s.b)
    length = 2.0 / math.pi * nan0(weakening) ** -2 * s.state_evolution()
    within = (s.a > formulas.CRACK_LIMIT * s.b) & (s.a < s.b)
    return valid(within, length)


def _loaded_patch(s: Setting) -> Numbers:
    within = (s.a > 0.0) & (s.a < NEAREST * s.b)
    ratio = where(within, s.a / nan0(s.b), 0.5)
    length = loaded_patch_factor(ratio) / (1.0 - ratio) * s.state_evolution()
    return valid(within, length)


_GAP = (
    f"between {formulas.LOCALISED_LIMIT} and 1/2 neither length of Rubin and Ampuero holds: "
    "simulated zones are longer than their fixed length there, by 5 % for a/b = 0.4 and 17 % for "
    "0.45"
)
_STEADY = "velocity weakening, near steady sliding, either law"

_OF_ONE_MATERIAL = (
    Length(
        key="homogeneous_sliding",
        title="homogeneous sliding",
        formula="pi mu* D/(zeta sigma0)",
        source="Rice and Ruina (1983); Aldam et al. (2017), Eq. (6)",
        question="above which wavelength is steady sliding unstable?",
        setting=_STEADY,
        compute=lambda s: s.plane(math.pi),
    ),
    Length(
        key="rice_ruina",
        title="Rice-Ruina h*",
        formula="(pi/4) mu* D/(zeta sigma0)",
        source="Rice and Ruina (1983); Lapusta and Liu (2009)",
        question="how large may a patch that moves like one spring block be?",
        setting=_STEADY,
        compute=lambda s: s.plane(0.25 * math.pi),
    ),
    *(
        Length(
            key=f"dieterich_{end}",
            title=f"conventional, eta = {words}",
            formula="eta mu D/(zeta sigma0)",
            source="Dieterich (1992), Table 1; Aldam et al. (2017), Eqs. (1)-(3)",
            question="what does a spring block as stiff as a crack estimate?",
            setting=f"{_STEADY}; {end} of the crack models",
            compute=methodcaller("conventional", eta),
        )
        for end, words, eta in zip(
            ("shortest", "longest"), ("2/pi", "4/3"), formulas.CONVENTIONAL_ETA, strict=True
        )
    ),
    Length(
        key="state_evolution",
        title="state evolution L_b",
        formula="mu* D/(b sigma0)",
        source="Dieterich (1992); Rubin and Ampuero (2005)",
        question="over which length does friction fall behind a front?",
        setting="far above steady state",
        needs="b > 0",
        compute=Setting.state_evolution,
    ),
    Length(
        key="rubin_ampuero_localised",
        title="Rubin-Ampuero, fixed length",
        formula="2 x 1.3774 mu* D/(b sigma0)",
        source="Rubin and Ampuero (2005), 2 L_nu",
        question="how long is a patch that accelerates?",
        setting="aging law, far above steady state; a/b < 0.3781",
        needs=f"a/b < {formulas.LOCALISED_LIMIT}",
        beyond=_GAP,
        evolution="aging",
        compute=lambda s: valid(
            s.a < formulas.LOCALISED_LIMIT * s.b, formulas.LOCALISED_FACTOR * s.state_evolution()
        ),
    ),
    Length(
        key="rubin_ampuero_crack",
        title="Rubin-Ampuero, expanding",
        formula="(2/pi) mu* b D/[(b - a)^2 sigma0]",
        source="Rubin and Ampuero (2005), 2 L_infinity",
        question="how long does a patch that accelerates become as it expands?",
        setting="aging law, crack-like expansion; 1/2 < a/b < 1",
        needs="1/2 < a/b < 1",
        beyond=_GAP,
        evolution="aging",
        compute=_crack,
    ),
    Length(
        key="uenishi_rice",
        title="Uenishi-Rice",
        formula="1.158 mu*/W, W = b sigma0/D unless given",
        source="Uenishi and Rice (2003)",
        question="when is a patch unstable whose strength falls by W per slip?",
        setting="strength falls linearly with slip, without direct effect",
        needs=f"a/b < {formulas.NEGLIGIBLE} unless W is given",
        compute=lambda s: valid(
            s.weakening_rate > 0.0, formulas.FINITE_PATCH * s.modulus / nan0(s.weakening_rate)
        ),
    ),
    Length(
        key="creeping_asperity",
        title="asperity, rigid surroundings",
        formula="1.158 mu* D/(zeta sigma0)",
        source="Viesca and Garagash (2025), first scenario, by our derivation; "
        "Uenishi and Rice (2003)",
        question="how long may a patch of fixed length be among surroundings that creep at V?",
        setting="patch in steady creep, rigid surroundings; else W_c, by --outside-zeta",
        compute=lambda s: s.plane(formulas.FINITE_PATCH),
    ),
    Length(
        key="loaded_patch",
        title="pinned patch, steady load",
        formula="C(a/b) mu* D/(zeta sigma0)",
        source="Viesca and Garagash (2025), second scenario, by our computation of C",
        question="how long may a patch of fixed length be between stuck ends under a rising load?",
        setting="velocity weakening, either law",
        needs=f"0 < a/b < {NEAREST}",
        compute=_loaded_patch,
    ),
    Length(
        key="thin_limit",
        title="thin layer, Hk -> 0",
        formula="2 pi sqrt[2 mu* H D/(zeta sigma0)]",
        source="Aldam et al. (2017), Eq. (11)",
        question="above which wavelength is steady sliding unstable?",
        setting=f"{_STEADY}; 2 pi H/L << 1",
        system=RIGID_BASE,
        needs=f"zeta > 0 and 2 pi H/L < {formulas.THIN}",
        compute=lambda s: s.thin(2.0 * s.height * s.plane(0.25 * math.pi) * 4.0 / math.pi),
    ),
    Length(
        key="thin_layer",
        title="thin layer, aging law",
        formula="2 pi sqrt[2 mu* H D/(b sigma0)]",
        source="Viesca (2016)",
        question="how long is a patch that accelerates?",
        setting="aging law, far above steady state; a/b < 1/2; 2 pi H/L << 1",
        system=RIGID_BASE,
        needs=f"a/b < 1/2 and 2 pi H/L < {formulas.THIN}",
        evolution="aging",
        compute=lambda s: s.thin(2.0 * s.height * valid(s.a < 0.5 * s.b, s.state_evolution())),
    ),
)
_OF_TWO_MATERIALS = tuple(
    length.of_two()
    for length in _OF_ONE_MATERIAL
    if length.system == HALF_SPACES and "mu*" in length.formula
)
LENGTHS = (*_OF_ONE_MATERIAL, *_OF_TWO_MATERIALS)
"""The lengths in use, in the order of their listing."""


def values_of(
    fault: FaultLike, weakening_rate: Values | None = None, lengths: Iterable[Length] = LENGTHS
) -> dict[str, Numbers]:
    """Lengths (m) of a fault by key, NaN outside their validity.

    The slip weakening W (Pa/m) of Uenishi and Rice's length is ``b sigma0/D`` by default, where
    ``a/b < 0.1``.
    """
    if weakening_rate is None:
        usual = fault.b * fault.normal_stress / fault.slip_distance
        rate = valid(fault.a < formulas.NEGLIGIBLE * fault.b, usual)
    else:
        rate = checked("weakening_rate", weakening_rate, WEAKENING_RATE)
    with np.errstate(over="ignore"):  # of the highest bodies and the least weakening
        return {length.key: length.evaluate(fault, rate) for length in lengths}


def expanding_length(
    fault: FaultLike,
    slip_rate: float | Numbers,
    far_slip_rate: float | Numbers,
    far_state_ratio: float | Numbers,
) -> Numbers:
    """The full length (m) of Rubin and Ampuero's expanding zone at a finite slip rate (m/s).

    NaN outside ``1/2 < a/b < 1``, where the slip rate does not exceed the one far ahead, and where
    the stress does not drop.

    Rubin and Ampuero (2005), with ``w = log(v/v_far)``:

        (2 L_b/pi) [(w + log W)/((1 - a/b) w + log W)]^2

    At the tip the strength decreases by ``b sigma0 (w + log W)`` over ``w + log W`` slip distances
    D; within the zone the stress decreases by ``sigma0 [(b - a) w + b log W]``. For ``W = 1``, and
    for any W in the limit of infinite slip rate, the length is that of ``rubin_ampuero_crack``.
    """
    asymptote = values_of(fault)["rubin_ampuero_crack"]
    acceleration = np.log(slip_rate / far_slip_rate)
    weakening = fault.zeta / nan0(fault.b)
    strength_drop = acceleration + np.log(far_state_ratio)
    stress_drop = weakening * acceleration + np.log(far_state_ratio)
    length = asymptote * (weakening * strength_drop / nan0(stress_drop)) ** 2
    return valid((acceleration > 0.0) & (stress_drop > 0.0), length)
