"""Tables of the report: runs with their lengths and cost, faults, and CSV for downloads."""

import math
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from nucleation.model.identity import DIGITS

from ..tables.rows import rows_of

_QUANTITIES = {
    "shear_modulus": ("μ (GPa)", 1e9),
    "poisson_ratio": ("ν", 1.0),
    "normal_stress": ("σ₀ (MPa)", 1e6),
    "friction": ("f", 1.0),
    "a": ("a", 1.0),
    "zeta": ("ζ", 1.0),
    "slip_distance": ("ℓ = D (µm)", 1e-6),
    "velocity": ("V (µm/s)", 1e-6),
}
"""Columns that distinguish faults for the theory, together with :data:`_SECOND_BODY`: their titles
and units. Runs that differ only in height, law or initial state are of the same fault."""

_SECOND_BODY = (
    "below",
    "far_side",
    "second_shear_modulus",
    "second_poisson_ratio",
    "plane",
)

LENGTH_COLUMNS = (
    "Simulation",
    "H (m)",
    "Onset (s)",
    "Length (m)",
    "Range (m)",
    "Over theory",
    "Elements",
    "Steps",
    "Time (s)",
    "Memory (MB)",
)
RUN_COLUMNS = (
    "Simulation",
    "Fault",
    "H (m)",
    "Onset (s)",
    "Length (m)",
    "Range (m)",
    "Theory (m)",
    "Over theory",
)


class _Fault(NamedTuple):
    number: int  # starts at one
    values: dict[str, float]  # by column, SI units
    runs: list[int]  # rows of the table


def faults(lengths: xr.Dataset) -> list[_Fault]:
    """The faults of a table of lengths, in the order of their first runs."""
    runs: dict[tuple[float | str, ...], list[int]] = {}
    columns = [lengths[name].values.tolist() for name in (*_QUANTITIES, *_SECOND_BODY)]
    for i, values in enumerate(zip(*columns, strict=True)):
        mark = tuple(_mark(value) for value in values)
        runs.setdefault(mark, []).append(i)
    found = []
    for number, (mark, own) in enumerate(runs.items(), start=1):
        numbers = [float(value) for value in mark[: len(_QUANTITIES)]]
        found.append(
            _Fault(
                number,
                dict(zip(_QUANTITIES, numbers, strict=True)),
                own,
            )
        )
    return found


def _mark(value: float | str) -> float | str:
    """A value for the comparison of faults: round-off is removed from numbers."""
    if isinstance(value, float | int) and np.isfinite(value):
        return float(f"{value:.{DIGITS}g}")
    return str(value)


def number(value: float, digits: int = 4) -> str:
    """Write a number.

    Parameters
    ----------
    value : float
        The number.
    digits : int
        Significant digits.

    Returns
    -------
    str
        A dash if the number is not finite.
    """
    return f"{value:.{digits}g}" if math.isfinite(value) else "–"


def run_rows(lengths: xr.Dataset, columns: tuple[str, ...]) -> list[dict[str, str]]:
    """A row for each simulation.

    Parameters
    ----------
    lengths : Dataset
        Table of lengths.
    columns : tuple of str
        Titles of the columns, such as :data:`LENGTH_COLUMNS`.

    Returns
    -------
    list of dict
        Texts by column.
    """
    fault_of_run = {}
    for fault in faults(lengths):
        for i in fault.runs:
            fault_of_run[i] = fault.number
    rows = []
    for i, run in enumerate(rows_of(lengths)):
        cells = _cells(run) | {"Fault": str(fault_of_run[i])}
        rows.append({name: cells[name] for name in columns})
    return rows


def _cells(run: dict[str, Any]) -> dict[str, str]:
    low = number(run["length_low"], 3)
    high = number(run["length_high"], 3)
    return {
        "Simulation": str(run["id"]),
        "H (m)": number(run["height"]),
        "Onset (s)": number(run["onset_time"]),
        "Length (m)": number(run["length"]),
        "Range (m)": f"{low} to {high}" if math.isfinite(run["length_low"]) else "–",
        "Theory (m)": number(run["critical_length"]),
        "Over theory": number(run["length"] / run["critical_length"], 3),
        "Elements": f"{run['n_x']} × {run['n_y']}",
        "Steps": str(run["steps"]),
        "Time (s)": number(run["wall_seconds"], 3),
        "Memory (MB)": number(run["peak_megabytes"], 3),
    }


def fault_rows(lengths: xr.Dataset) -> list[dict[str, str]]:
    """A row for each fault of a table of lengths: texts by column."""
    rows = []
    for fault in faults(lengths):
        row = {"Fault": str(fault.number)}
        for name, (title, unit) in _QUANTITIES.items():
            row[title] = number(fault.values[name] / unit)
        row["Runs"] = str(len(fault.runs))
        rows.append(row)
    return rows


def csv_of(dataset: xr.Dataset, variables: tuple[str, ...] = ()) -> bytes:
    """Write variables of a dataset as CSV, with units in the titles.

    Parameters
    ----------
    dataset : Dataset
        A dataset with metadata. If it has the dimension ``run``, only variables on ``run`` are
        written, since a line for each pair of coordinates would be too many.
    variables : tuple of str
        The written variables; without any, all are written.

    Returns
    -------
    bytes
        The file.
    """
    chosen = dataset[list(variables)] if variables else dataset
    if "run" in chosen.dims:
        chosen = chosen.drop_dims({*chosen.dims} - {"run"})
    frame = chosen.to_dataframe().reset_index()
    frame = frame.drop(columns=[name for name in frame if name not in dataset.variables])
    titles = {}
    for name in frame:
        unit = dataset[name].attrs.get("units", "1")
        titles[name] = name if unit == "1" else f"{name} ({unit})"
    return bytes(frame.rename(columns=titles).to_csv(index=False).encode())
