"""The lengths of the literature as answers, each with how the fault differs from its setting."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..lengths.formulas import TWO_MATERIALS, Length
from ..lengths.in_use import LENGTHS, values_of
from ..theory.status import STABLE, UNKNOWN, VALUE
from ..theory.values import FaultLike, Numbers, Values, labelled
from .answer import Answer, elementwise


def answers_of_literature(
    fault: FaultLike, weakening_rate: Values | None = None
) -> dict[str, Answer]:
    """The lengths of the literature by key, with W (Pa/m) of Uenishi and Rice's."""
    second = fault.second_shear_modulus
    differ = (second != fault.shear_modulus) | (fault.second_poisson_ratio != fault.poisson_ratio)
    of_two = bool(np.any(np.isfinite(second) & differ))
    used = [one for one in LENGTHS if of_two or one.system != TWO_MATERIALS]
    values = values_of(fault, weakening_rate, used)
    return {one.key: _answer(one, values[one.key], differ, fault) for one in used}


def _answer(one: Length, length: Numbers, differ: Any, fault: FaultLike) -> Answer:
    """A length of the literature; NaN means a stable fault if zeta <= 0, else another range."""
    facts = one.facts(fault)
    names = list(facts)

    def reason_of(value: float, *numbers: float) -> str:
        if np.isfinite(value):
            return ""
        known = []
        for name, fact in zip(names, numbers, strict=True):
            unit = " m" if name == "H" else ""
            known.append(f"{name} = {fact:.4g}{unit}")
        return f"needs {one.needs}: {', '.join(known)}"

    def status_of(value: float, zeta: float) -> str:
        if np.isfinite(value):
            return VALUE
        return STABLE if zeta <= 0.0 else UNKNOWN

    def unlike(value: float, height: float, second_height: float, differ: float) -> str:
        if not np.isfinite(value):
            return ""
        return one.unlike(fault, min(height, second_height), bool(differ))

    texts = [
        elementwise(status_of, length, fault.zeta),
        elementwise(reason_of, length, *facts.values()),
        elementwise(unlike, length, fault.height, fault.second_height, differ),
    ]
    if not any(map(labelled, texts)):
        length, *texts = (x[()] for x in np.broadcast_arrays(length, *texts))
    return Answer(length, length, length, *texts)
