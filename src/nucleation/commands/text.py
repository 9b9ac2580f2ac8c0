"""What several commands print: parameters with units, and what was extracted from a run."""

import json
import math
import os
import re
import shlex
import textwrap
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ..answers.status import Answers
from ..model.parameters import GROUPS, Parameters
from ..model.quantities import ParameterError, Quantity, declarations


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


def wrapped(*texts: str) -> list[str]:
    """The lines of some texts; all but the first of each are indented."""
    return [line for text in texts for line in textwrap.wrap(text, 95, subsequent_indent="  ")]


def with_unit(value: Any, entry: Quantity) -> str:
    """A value as text with its unit."""
    number = f"{value:.6g}" if isinstance(value, float) else str(value)
    return number if entry.unit == "1" else f"{number} {entry.unit}"


def event_lines(found: dict[str, float], theory_length: float) -> list[str]:
    """Onset, and length of the patch then, with their spread over the definitions.

    The theory's length (m) is NaN where homogeneous sliding is stable.
    """
    if math.isnan(found["onset_time"]):
        return ["no event: the force has not dropped"]
    onset, length = (
        f"{found[name]:.4g} ({found[f'{name}_low']:.4g} to {found[f'{name}_high']:.4g})"
        for name in ("onset_time", "length")
    )
    ratio = found["length"] / theory_length
    over_theory = "" if math.isnan(ratio) else f", {ratio:.3g} L_c"
    return [f"onset: {onset} s", f"L: {length} m{over_theory}"]


def outcome(dataset: Any) -> dict[str, Any]:
    """How a simulation ended and what was extracted from it, for JSON (SI units)."""
    from ..analysis.extraction import extract  # with the libraries of arrays, which take a second

    return {
        "status": dataset.attrs["status"],
        "steps": int(dataset.attrs["steps"]),
        "wall_seconds": float(dataset.attrs["wall_seconds"]),
        "simulated_time": float(dataset["step_time"][-1]),
        "event": extract(dataset),
    }


def as_plain(answer: Answers) -> dict[str, Any]:
    """A length of one fault with its status, for JSON."""
    return {
        "length": float(answer.length),
        "status": str(answer.status),
        "reason": str(answer.reason),
    }


def to_json(found: Mapping[str, Any]) -> str:
    """What a command found, as JSON in SI units: null for NaN, text for infinity."""
    return json.dumps(_plain(found), indent=2)


def _plain(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {key: _plain(one) for key, one in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(one) for one in value]
    if value is None or isinstance(value, (str, int)):
        return value
    number = float(value)
    return None if math.isnan(number) else "inf" if math.isinf(number) else number


def require_writable(path: Path, force: bool) -> None:
    """Refuse a file that can't be written, or exists and may not be replaced by `force`."""
    if path.exists() and not force:
        raise ParameterError(f"{path} exists already; --force replaces it")
    require_directory(path, path.absolute().parent)


def require_directory(path: Path, folder: Path) -> None:
    """Refuse a path whose directory isn't there, or can't be written to."""
    if not folder.exists():
        make = shlex.join(["mkdir", "-p", str(folder)])
        raise ParameterError(f"{path} can't be written: there is no directory {folder}; {make}")
    if not folder.is_dir() or not os.access(folder, os.W_OK):
        raise ParameterError(f"{path} can't be written: {folder} is no writable directory")
