"""Fields of the fault as CSV; series at points of it in the format of the SEAS benchmarks.

On-fault files of the benchmark BP3, plane strain with inertia and a normal stress that changes
(Erickson and others, 2023, Bull. Seismol. Soc. Am. 113, 499-523, doi:10.1785/0120220066; those of
BP1 and BP2 lack the normal stress): a header of lines with ``#`` that give problem, author, date,
code, its version, element, station, steps and columns; one line without it, the names of the
fields; and a line for each time with time (s), slip (m), decimal logarithm of the slip rate (m/s),
shear stress (MPa), normal stress (MPa, positive in compression) and the logarithm of the state (s).
"""

import io
import json

import numpy as np
import xarray as xr

from ..model.quantities import ParameterError
from .record import Record

FIELDS = (
    ("t", "Time (s)"), ("slip", "Slip (m)"), ("slip_rate", "Slip rate (log10 m/s)"),
    ("shear_stress", "Shear stress (MPa)"), ("normal_stress", "Normal stress (MPa)"),
    ("state", "State (log10 s)"),
)  # fmt: skip
"""Names of the fields, and what the header says of them."""


def time_series(simulation: xr.Dataset, position: float) -> str:
    """The record of a simulation at a distance (m) from the loaded edge.

    Between nodes fields are linear in x, and rates and states by their logarithms.

    Raises
    ------
    ParameterError
        If the position is not on the interface.
    DatasetError
        If the run recorded only what lengths need.
    """
    record = Record(simulation)
    record.require("slip", "shear_stress", "step_size")
    x, steps = record.x, simulation["step_size"].values[1:]
    if not x[0] <= position <= x[-1]:
        raise ParameterError(
            f"at = {position:g} m is not allowed: it must lie on the interface, in [0, {x[-1]:g}] m"
        )
    node = min(int(np.searchsorted(x, position, side="right")) - 1, x.size - 2)
    part = (position - x[node]) / (x[node + 1] - x[node])

    def at(name: str, logarithm: bool = False) -> np.ndarray:
        values = simulation[name].values[:, node : node + 2]
        values = np.log10(np.maximum(np.abs(values), 1e-300)) if logarithm else values
        return (1.0 - part) * values[:, 0] + part * values[:, 1]

    columns = (
        record.time, at("slip"), at("slip_rate", True), 1e-6 * at("shear_stress"),
        -1e-6 * at("normal_stress"), at("state", True),
    )  # fmt: skip
    made = str(simulation.attrs.get("created", "not given")).partition("T")[0].replace("-", "/")
    versions = json.loads(simulation.attrs.get("versions", "{}"))
    header = [
        "This is the file header:",
        f"problem=none of the benchmarks: {simulation.attrs.get('command', 'a run of its own')}",
        "author=not given",
        f"date={made}",
        "code=nucleation",
        f"code_version={versions.get('nucleation', 'not given')}",
        f"element_size={x[1] - x[0]:g} m",
        f"location=on fault, {position:g} m from the loaded edge",
        f"minimum_time_step={steps.min():g}",
        f"maximum_time_step={steps.max():g}",
        f"num_time_steps={record.time.size}",
        *(f"Column #{i + 1} = {text}" for i, (_, text) in enumerate(FIELDS)),
        "",
        "The line below lists the names of the data fields:",
    ]
    lines = [*(f"# {line}".rstrip() for line in header), " ".join(name for name, _ in FIELDS)]
    lines += ["# Here is the time-series data."]
    lines += [" ".join(f"{value:.15e}" for value in row) for row in zip(*columns, strict=True)]
    return "\n".join(lines) + "\n"


def field_tables(simulation: xr.Dataset) -> dict[str, str]:
    """Every field on (time, x) as CSV, by name: SI units, times (s) down and x (m) across."""
    x = ",".join(f"{value:.12g}" for value in simulation["x"].values)
    time = simulation["time"].values
    tables = {}
    for name, field in simulation.data_vars.items():
        if set(field.dims) == {"time", "x"}:
            head = f"{name} ({field.attrs['units']}): time (s) down / x (m) across,{x}\n"
            text = io.StringIO()
            rows = np.column_stack([time, field.transpose("time", "x").values])
            np.savetxt(text, rows, fmt="%.9g", delimiter=",")
            tables[str(name)] = head + text.getvalue()
    return tables
