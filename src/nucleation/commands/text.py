"""Output that several commands share: parameters with units, events, JSON."""

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
                continue  # a rigid base lacks it, or a second block has that of the first
            value = with_unit(getattr(own, name), entry)
            meaning = re.split("[;:,]", entry.description)[0]
            lines.append(f"  {name:<28} {value:<16} {meaning}")
    return lines


def wrapped(*texts: str) -> list[str]:
    """Texts wrapped into lines; all but the first line of each text are indented."""
    lines: list[str] = []
    for text in texts:
        lines += textwrap.wrap(text, 95, subsequent_indent="  ")
    return lines


def with_unit(
    value: Any,
    entry: Quantity,
) -> str:
    """A value as text with its unit.

    Parameters
    ----------
    value : float, int or str
        In SI units.
    entry : Quantity
        Declaration of the parameter.

    Returns
    -------
    str
    """
    number = f"{value:.6g}" if isinstance(value, float) else str(value)
    return number if entry.unit == "1" else f"{number} {entry.unit}"


def event_lines(
    found: dict[str, float],
    critical_length: float,
) -> list[str]:
    """Onset of the event and length of the patch then, with their ranges over the definitions.

    Parameters
    ----------
    found : dict
        The event of a run, from :func:`nucleation.analysis.extraction.extract`.
    critical_length : float
        L_c of the theory (m); NaN if homogeneous sliding is stable.

    Returns
    -------
    list of str
    """
    if math.isnan(found["onset_time"]):
        return ["no event: the force has not dropped"]
    onset, length = (_with_spread(found, name) for name in ("onset_time", "length"))
    over_theory = ""
    if not math.isnan(critical_length):
        over_theory = f", {found['length'] / critical_length:.3g} L_c"
    return [f"onset: {onset} s", f"L: {length} m{over_theory}"]


def _with_spread(
    found: dict[str, float],
    name: str,
) -> str:
    """A value of an event with its range over the definitions."""
    low, high = found[f"{name}_low"], found[f"{name}_high"]
    return f"{found[name]:.4g} ({low:.4g} to {high:.4g})"


def outcome(dataset: Any) -> dict[str, Any]:
    """The status and the event of a simulation, for JSON, in SI units."""
    from ..analysis.extraction import extract  # imported here, since the libraries take a second

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
    """The answer of a command as JSON: null for NaN, text for infinity."""
    return json.dumps(_plain(found), indent=2)


def _plain(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {key: _plain(one) for key, one in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(one) for one in value]
    if value is None or isinstance(value, (str, int)):
        return value
    number = float(value)
    if math.isnan(number):
        return None
    return "inf" if math.isinf(number) else number


def require_writable(
    path: Path,
    force: bool,
) -> None:
    """Refuse a file that can't be written, or exists and may not be replaced.

    Parameters
    ----------
    path : Path
        The file.
    force : bool
        Whether an existing file may be replaced.

    Raises
    ------
    ParameterError
        If the file can't be written.
    """
    if path.exists() and not force:
        raise ParameterError(f"{path} exists already; --force replaces it")
    folder = path.absolute().parent
    if not folder.exists():
        make = shlex.join(["mkdir", "-p", str(folder)])
        raise ParameterError(f"{path} can't be written: there is no directory {folder}; {make}")
    if not folder.is_dir() or not os.access(folder, os.W_OK):
        raise ParameterError(f"{path} can't be written: {folder} is no writable directory")
