"""Simulated drops beside the law's, one row for each run.

The law uses the theory's patches (:mod:`nucleation.drop.mode_history`). The drop of a quiet run
depends on mesh, steps and round-off. Its row has the strength at which a fluctuating load, or
state, would give the law's median at that length: the noise of that mesh with those steps, in the
units of a declared perturbation.
"""

import contextlib
import dataclasses
from collections.abc import Iterable
from typing import Any

import numpy as np
import xarray as xr

from nucleation.datasets.variables import Variable, annotate, some, table, to_csv
from nucleation.drop.delay import Growth, growth
from nucleation.drop.mode_history import ModeHistory, mode_history
from nucleation.model.settings import Perturbation
from nucleation.run.identity import fault
from nucleation.run.run import Run
from nucleation.theory.creep.lengths import stability_length_of
from nucleation.theory.status import NoLength

from .lengths import COLUMNS as LENGTHS
from .rows import Row, rows_of

MEASURED = some(
    LENGTHS,
    "study role id evolution height kind strength seed correlation_length n_x n_y "
    "block_length longest_step onset_time length critical_length",
)

PREDICTED = {
    "stability_length": LENGTHS["stability_length"],
    "front_length": Variable("m", "L_s by theory, with the advancing front", "L_s"),
    "law_length": Variable("m", "length at the drop by the law, median", "L"),
    "law_low": Variable("m", "length by which 16 % have dropped by the law", "L"),
    "law_high": Variable("m", "length by which 84 % have dropped by the law", "L"),
    "closed_form_length": Variable("m", "length at the drop by the law in one line", "L"),
    "effective_strength": Variable("1", "strength in the law's one line", "eps_eff"),
    "floor_normal_load": Variable("1", "strength of the load at which the law drops there"),
    "floor_state": Variable("1", "strength of the state at which the law drops there"),
}

COLUMNS = {**MEASURED, **PREDICTED, "fault": LENGTHS["fault"]}

CURVES = {
    "curve_fault": Variable("", "fault of a curve, as in the column fault"),
    "curve_kind": Variable("", "kind of perturbation of a curve"),
    "curve_strength": Variable("1", "relative strength", "eps"),
    "curve_length": Variable("m", "length at the drop by the law, median", "L"),
    "curve_low": Variable("m", "length by which 16 % have dropped by the law", "L"),
    "curve_high": Variable("m", "length by which 84 % have dropped by the law", "L"),
    "curve_closed_form": Variable("m", "length at the drop by the law in one line", "L"),
}
"""The law over the strength, for each fault under each of :data:`QUIET_KINDS`."""

CURVE_STRENGTHS = np.geomspace(1e-12, 1e-1, 89)

QUIET_KINDS = ("normal_load", "state")
"""Kinds of perturbation in which the noise of a quiet run is expressed."""

WEAK = 1e-5  # strength at which the one line gives L_s of a quiet run, which has no strength


class _Law:
    """The law of the drop for one fault, from the mode along its creep."""

    def __init__(self, history: ModeHistory, stability_length: float) -> None:
        self.history = history
        self.stability_length = stability_length
        self._known: dict[tuple[str, float], Growth] = {}

    def growth(self, kind: str, correlation_length: float = 0.0) -> Growth:
        """The mode's growth under one kind of perturbation."""
        key = kind, correlation_length
        if key not in self._known:
            declared = Perturbation(kind=kind)
            if correlation_length:
                declared = dataclasses.replace(declared, correlation_length=correlation_length)
            self._known[key] = growth(self.history, declared)
        return self._known[key]

    def lengths(self, kind: str, strength: float) -> tuple[float, float, float, float]:
        """Lengths (m) at the drop: the median, 16 and 84 %, and that of the law in one line."""
        law = self.growth(kind)
        drop = law.drop(strength)
        return drop.length, drop.low, drop.high, law.closed_form(self.history, strength).length

    def row(self, run: Row) -> Row:
        """The columns :data:`PREDICTED` of one run; NaN where they do not apply."""
        none = dict.fromkeys(PREDICTED, float("nan"))
        if run["kind"] == "none":
            return none | self._row_of_quiet_run(run["length"])
        law = self.growth(run["kind"], run["correlation_length"])
        drop = law.drop(run["strength"])
        closed = law.closed_form(self.history, run["strength"])
        return none | {
            "stability_length": self.stability_length,
            "front_length": closed.front_length,
            "law_length": drop.length,
            "law_low": drop.low,
            "law_high": drop.high,
            "closed_form_length": closed.length,
            "effective_strength": closed.effective,
        }

    def _row_of_quiet_run(self, length: float) -> Row:
        closed = self.growth("normal_load").closed_form(self.history, WEAK)
        floors = {f"floor_{kind}": self.growth(kind).strength_at(length) for kind in QUIET_KINDS}
        return {
            "stability_length": self.stability_length,
            "front_length": closed.front_length,
            **floors,
        }


def gather_drops(
    drops: Iterable[xr.Dataset], runs: Iterable[Row], quiet: Iterable[xr.Dataset] = ()
) -> xr.Dataset:
    """The drops of all runs beside the law, for the faults of some runs."""
    return _beside(_laws(runs), [*drops, *quiet])


def drop_files(
    drops: Iterable[xr.Dataset], runs: Iterable[Row], quiet: Iterable[xr.Dataset] = ()
) -> dict[str, Any]:
    """The table of :func:`gather_drops` as CSV, and with :data:`CURVES`."""
    laws = _laws(runs)
    rows = _beside(laws, [*drops, *quiet])
    return {".nc": rows.merge(law_curves(laws)), ".csv": to_csv(rows)}


def law_curves(laws: dict[str, _Law]) -> xr.Dataset:
    """:data:`CURVES` on ``case`` and ``curve``, from the law by fault."""
    cases = [(name, kind) for name in laws for kind in QUIET_KINDS]
    values = [[laws[name].lengths(kind, x) for x in CURVE_STRENGTHS] for name, kind in cases]
    shape = len(cases), CURVE_STRENGTHS.size, 4
    length, low, high, closed_form = np.moveaxis(
        np.reshape(values, shape),
        -1,
        0,
    )
    along = ("case", "curve")
    found = xr.Dataset(
        {
            "curve_fault": ("case", [name for name, _ in cases]),
            "curve_kind": ("case", [kind for _, kind in cases]),
            "curve_strength": ("curve", CURVE_STRENGTHS),
            "curve_length": (along, length),
            "curve_low": (along, low),
            "curve_high": (along, high),
            "curve_closed_form": (along, closed_form),
        }
    )
    return annotate(found, CURVES)


def _laws(runs: Iterable[Row]) -> dict[str, _Law]:
    """The law by fault, without faults that have no patches the theory can follow."""
    laws = {}
    for run in runs:
        parameters = Run.from_dict(run["parameters"])
        with contextlib.suppress(NoLength):
            critical = run["critical_length"]
            own = parameters.fault
            stress = parameters.start.initial_shear_stress / own.normal_stress
            patches = parameters.patches
            history = mode_history(patches, critical, own.initial_state, stress)
            laws[fault(parameters)] = _Law(history, stability_length_of(patches, critical))
    return laws


def _beside(laws: dict[str, _Law], tables: Iterable[xr.Dataset]) -> xr.Dataset:
    """:data:`COLUMNS` of all runs of the faults that have a law."""
    rows = []
    for measured in tables:
        for row in rows_of(measured, names=(*MEASURED, "fault")):
            if row["fault"] in laws:
                rows.append(row | laws[row["fault"]].row(row))
    return table(rows, COLUMNS)
