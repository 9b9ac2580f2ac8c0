"""What several commands print: parameters with units, and what was extracted from a run."""

from __future__ import annotations

import math
import re
from typing import Any

from ..model.parameters import GROUPS, Parameters
from ..model.quantities import Quantity, declarations


def parameter_lines(parameters: Parameters) -> list[str]:
    """The parameters of a simulation, one in a line, with unit and meaning."""
    lines = []
    for group in GROUPS:
        own = getattr(parameters, group)
        lines.append(f"{group}:")
        for name, entry in declarations(type(own)).items():
            if getattr(own, name) is None:
                continue  # what a rigid base does not have, or a second block has like the first
            value = with_unit(getattr(own, name), entry)
            meaning = re.split("[;:,]", entry.description)[0]
            lines.append(f"  {name:<28} {value:<16} {meaning}")
    return lines


def with_unit(value: Any, entry: Quantity) -> str:
    """A value as text with its unit."""
    number = f"{value:.6g}" if isinstance(value, float) else str(value)
    return number if entry.unit == "1" else f"{number} {entry.unit}"


def event_lines(found: dict[str, float], theory_length: float | None) -> list[str]:
    """Onset and critical length of a run, with their spread over the definitions."""
    if math.isnan(found["onset_time"]):
        return ["no event: the force has not dropped"]
    spread = {
        name: f"{found[name]:.4g} ({found[f'{name}_low']:.4g} to {found[f'{name}_high']:.4g})"
        for name in ("onset_time", "length")
    }
    ratio = f", {found['length'] / theory_length:.3g} of the theory's" if theory_length else ""
    return [f"onset: {spread['onset_time']} s", f"L_c: {spread['length']} m{ratio}"]
