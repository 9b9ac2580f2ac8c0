"""Simulated drops beside the theory: the law of the drop, L_s and L_run.

One table has the law alone, by the theory's patches (:mod:`nucleation.drop.mode_history`). A quiet
run has no strength; its row has the strength at which a fluctuating load, or state, would give the
law's median at that length: the noise of mesh, steps and round-off. The other tables have the
answer for each fault, from weak to strong weakening: where zeta/a is small the patch slips slowly
in a limit cycle up to L_run, and where it is large the law of the drop holds.
"""

import dataclasses
from collections.abc import Iterable
from typing import Any

import numpy as np
import xarray as xr

from nucleation.datasets.variables import Column, annotate, columns, table, to_csv
from nucleation.drop.delay import Growth, growth
from nucleation.drop.mode_history import ModeHistory, mode_history
from nucleation.extraction import definitions
from nucleation.model.settings import Perturbation
from nucleation.run.derived import drop_of_run, ensemble, fault
from nucleation.run.run import Run
from nucleation.theory.creep.lengths import stability_length_of
from nucleation.theory.status import NoLength

from . import columns as col
from .rows import Row, rows_of

# -- the law ------------------------------------------------------------------------------------

MEASURED = columns(
    col.STUDY,
    col.ROLE,
    col.ID,
    col.EVOLUTION,
    col.HEIGHT,
    col.KIND,
    col.STRENGTH,
    col.SEED,
    col.CORRELATION_LENGTH,
    col.N_X,
    col.N_Y,
    col.BLOCK_LENGTH,
    col.LONGEST_STEP,
    definitions.ONSET_TIME,
    definitions.LENGTH,
    col.CRITICAL_LENGTH,
)

LAW = columns(col.LAW_LENGTH, col.LAW_LOW, col.LAW_HIGH)

PREDICTED = columns(
    definitions.STABILITY_LENGTH,
    col.FRONT_LENGTH,
    col.LAW_LENGTH,
    col.LAW_LOW,
    col.LAW_HIGH,
    Column("floor_normal_load", "1", "strength of the load at which the law drops there"),
    Column("floor_state", "1", "strength of the state at which the law drops there"),
)

COLUMNS = {**MEASURED, **PREDICTED, "fault": col.FAULT}

CURVES = columns(
    Column("curve_fault", "", "fault of a curve, as in the column fault"),
    Column("curve_kind", "", "kind of perturbation of a curve"),
    Column("curve_strength", "1", "relative strength", "eps"),
    Column("curve_length", "m", "length at the drop by the law, median", "L"),
    Column("curve_low", "m", "length by which 16 % have dropped by the law", "L"),
    Column("curve_high", "m", "length by which 84 % have dropped by the law", "L"),
    Column("curve_closed_form", "m", "length at the drop by the law in one line", "L"),
)
"""The law over the strength, for each fault under each of :data:`KINDS`."""

KINDS = ("normal_load", "state")
CURVE_STRENGTHS = np.geomspace(1e-12, 1e-1, 89)
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

    def row(self, run: Row) -> Row:
        """The columns :data:`PREDICTED` of one run; NaN where they do not apply."""
        found = dict.fromkeys(PREDICTED, float("nan"))
        found["stability_length"] = self.stability_length
        strength = run["strength"]
        if run["kind"] == "none":
            law, strength = self.growth("normal_load"), WEAK
            for kind in KINDS:
                found[f"floor_{kind}"] = self.growth(kind).strength_at(run["length"])
        else:
            law = self.growth(run["kind"], run["correlation_length"])
            drop = law.drop(strength)
            found |= dict(zip(LAW, (drop.length, drop.low, drop.high), strict=True))
        found["front_length"] = law.closed_form(self.history, strength).front_length
        return found


def drop_files(
    drops: Iterable[xr.Dataset], runs: Iterable[Row], quiet: Iterable[xr.Dataset] = ()
) -> dict[str, Any]:
    """:data:`COLUMNS` of all runs of the faults that have a law as CSV, and with :data:`CURVES`.

    `runs` are one of each fault. Faults without patches that the theory can follow have no law.
    """
    laws = {}
    for run in runs:
        parameters = Run.from_dict(run["parameters"])
        own, patches, critical = parameters.fault, parameters.patches, run["critical_length"]
        stress = parameters.start.initial_shear_stress / own.normal_stress
        try:
            history = mode_history(patches, critical, own.initial_state, stress)
            laws[fault(parameters)] = _Law(history, stability_length_of(patches, critical))
        except NoLength:
            continue
    rows = [
        row | laws[row["fault"]].row(row)
        for measured in (*drops, *quiet)
        for row in rows_of(measured)
        if row["fault"] in laws
    ]
    listed = table(rows, COLUMNS)
    return {".nc": listed.merge(law_curves(laws)), ".csv": to_csv(listed)}


def law_curves(laws: dict[str, _Law]) -> xr.Dataset:
    """:data:`CURVES` on ``case`` and ``curve``, from the law by fault."""
    cases = [(name, kind) for name in laws for kind in KINDS]
    values = np.empty((4, len(cases), CURVE_STRENGTHS.size))
    for i, (name, kind) in enumerate(cases):
        law = laws[name].growth(kind)
        for j, strength in enumerate(CURVE_STRENGTHS):
            drop = law.drop(strength)
            line = law.closed_form(laws[name].history, strength).length
            values[:, i, j] = drop.length, drop.low, drop.high, line
    columns = {
        "curve_fault": ("case", [name for name, _ in cases]),
        "curve_kind": ("case", [kind for _, kind in cases]),
        "curve_strength": ("curve", CURVE_STRENGTHS),
    }
    along = ("case", "curve")
    lines = {name: (along, line) for name, line in zip(list(CURVES)[3:], values, strict=True)}
    return annotate(xr.Dataset(columns | lines), CURVES)


# -- the answer for a fault ---------------------------------------------------------------------

EXPECTED = columns(
    definitions.STABILITY_LENGTH,
    col.RUNAWAY_LENGTH,
    col.RUNAWAY_STATUS,
    col.LAW_LENGTH,
    col.EXPECTED_LENGTH,
    col.EXPECTED_LOW,
    col.EXPECTED_HIGH,
    col.DOUBT,
)

WEAKENING = columns(
    col.STUDY,
    col.ID,
    col.EVOLUTION,
    col.HEIGHT,
    col.BELOW,
    col.KIND,
    col.STRENGTH,
    col.SEED,
    col.N_X,
    col.N_Y,
    col.BLOCK_LENGTH,
    definitions.ONSET_TIME,
    definitions.LENGTH,
    col.CRITICAL_LENGTH,
    col.ZETA_OVER_A,
    definitions.STABILITY_LENGTH,
    col.RUNAWAY_LENGTH,
    col.RUNAWAY_STATUS,
    col.LAW_LENGTH,
    col.EXPECTED_LENGTH,
    col.EXPECTED_LOW,
    col.EXPECTED_HIGH,
    col.DOUBT,
    col.FAULT,
)

WEAKENING_CURVES = columns(
    Column("curve_study", "", "study of the configuration"),
    Column("curve_below", "", "what the block slides on"),
    Column("curve_height", "m", "block height", "H"),
    Column("curve_half_spaces", "1", "whether the curves are those of half-spaces"),
    Column("curve_ratio", "1", "weakening over direct effect", "zeta/a"),
    Column("curve_stability", "1", "L_s over L_c", "L_s/L_c"),
    Column("curve_runaway", "1", "L_run over L_c, NaN where zeta/a > 2", "L_run/L_c"),
    Column("curve_law", "1", "length at the drop by the law over L_c, median", "L/L_c"),
)
"""The theory over zeta/a for each pair of study, base and height."""

WEAKENINGS = np.geomspace(0.2, 6.0, 22)  # zeta/a of the curves
AS_HALF_SPACES = 100.0  # factor of a height that makes a block a half-space

OTHER_FAULTS = columns(
    col.ZETA_OVER_A,
    col.FRICTION_LAW,
    col.EVOLUTION,
    col.HEIGHT,
    col.BELOW,
    col.FAR_SIDE,
    col.SHEAR_MODULUS,
    col.SECOND_SHEAR_MODULUS,
    col.KIND,
    col.STRENGTH,
    col.CRITICAL_LENGTH,
    definitions.STABILITY_LENGTH,
    col.RUNAWAY_LENGTH,
    col.RUNAWAY_STATUS,
    col.LAW_LENGTH,
    col.EXPECTED_LENGTH,
    col.EXPECTED_LOW,
    col.EXPECTED_HIGH,
    col.DOUBT,
    col.REALISATIONS,
    definitions.LENGTH,
    col.REACHED_LENGTH,
    col.INSIDE,
)


def expected(parameters: Run) -> Row:
    """The columns :data:`EXPECTED` of one fault under its perturbation; NaN without a drop."""
    try:
        known = drop_of_run(parameters)
    except NoLength as error:
        none = dict.fromkeys(EXPECTED, float("nan"))
        return none | {"runaway_status": error.status, "doubt": str(error)}
    return {
        "stability_length": known.stability_length,
        "runaway_length": known.runaway.length,
        "runaway_status": known.runaway.status,
        "doubt": known.doubt,
        "law_length": known.law.length,
        "expected_length": known.length,
        "expected_low": known.low,
        "expected_high": known.high,
    }


def weakening_files(drops: Iterable[xr.Dataset], runs: Iterable[Row]) -> dict[str, Any]:
    """The drops of all runs beside the theory of their faults as CSV, and with the curves."""
    runs = list(runs)
    by_fault = {}
    for run in runs:
        parameters = Run.from_dict(run["parameters"])
        by_fault[fault(parameters)] = expected(parameters)
    rows = []
    for lengths in drops:
        complete = lengths.assign(zeta_over_a=lengths["zeta"] / lengths["a"])
        rows += [row | by_fault[row["fault"]] for row in rows_of(complete)]
    listed = table(rows, WEAKENING)
    return {".nc": listed.merge(weakening_curves(runs)), ".csv": to_csv(listed)}


def weakening_curves(runs: Iterable[Row], ratios: Iterable[float] = WEAKENINGS) -> xr.Dataset:
    """Lengths by theory over zeta/a, of each study, base and height.

    Blocks on a deformable base that are higher than L_c in all their runs are as good as
    half-spaces; they have the curves of half-spaces.
    """
    systems: dict[tuple[str, str, float], list[Row]] = {}
    for run in runs:
        parameters = Run.from_dict(run["parameters"])
        base = "rigid" if parameters.below is None else "deformable"
        key = run["study"], base, parameters.fault.height
        systems.setdefault(key, []).append(run)
    ratios = list(ratios)
    rows = []
    for (study, base, height), own in systems.items():
        parameters = Run.from_dict(own[0]["parameters"])
        below = parameters.below
        is_high = below is not None and height > max(run["critical_length"] for run in own)
        if below is not None and is_high:
            parameters = parameters.replaced(
                height=AS_HALF_SPACES * height, second_height=AS_HALF_SPACES * below.height
            )
        lengths = []
        for ratio in ratios:
            weaker = parameters.replaced(zeta_over_a=ratio)
            known = expected(weaker)
            names = ("stability_length", "runaway_length", "law_length")
            lengths.append([known[name] / weaker.critical_length for name in names])
        rows.append((study, base, height, is_high, *np.transpose(lengths)))
    columns: dict[str, Any] = {"curve_ratio": ("curve", ratios)}
    drawn = [name for name in WEAKENING_CURVES if name not in columns]
    for name, values in zip(drawn, zip(*rows, strict=True), strict=True):
        along = ("system", "curve")[: np.ndim(values)]
        columns[name] = (along, np.array(values))
    return annotate(xr.Dataset(columns), WEAKENING_CURVES)


def gather_other_faults(drops: xr.Dataset, runs: Iterable[Row]) -> xr.Dataset:
    """The simulated drops of each fault, over its realisations, beside the theory."""
    rows = []
    for run in runs:
        parameters = Run.from_dict(run["parameters"])
        own = drops.isel(run=drops["ensemble"].values == ensemble(parameters))
        theory = expected(parameters)
        lengths = own["length"].values
        inside = (lengths >= theory["expected_low"]) & (lengths <= theory["expected_high"])
        first = rows_of(own)[0]
        simulated = {
            "zeta_over_a": first["zeta"] / first["a"],
            "realisations": lengths.size,
            "length": float(lengths.mean()),
            "reached_length": float(own["reached_length"].max()),
            "inside": int(inside.sum()),
        }
        rows.append(first | theory | simulated)
    return table(rows, OTHER_FAULTS)
