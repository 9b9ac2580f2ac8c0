"""docs/verification.md against the reference set, and the reference set against today's code."""

import csv
import io
from collections import defaultdict
from pathlib import Path

import numpy as np
import pytest
from verification.verification_page import rows

from nucleation.verification import orders

REFERENCE = Path(__file__).parents[2] / "results" / "reference"


def reference(name):
    text = (REFERENCE / name).read_text(encoding="utf-8")
    return list(csv.DictReader(io.StringIO(text)))


CONVERGENCE, DISPERSION = reference("verification.csv"), reference("dispersion.csv")
QUANTITIES = {
    "displacement": "displacement_error",
    "slip rate": "slip_rate_error",
    "log(phi)": "log_state_error",
}


def test_orders_on_the_finest_level_are_those_of_the_reference():
    for cells, refinement in zip(
        rows("Orders of convergence"), ("mesh", "step", "quasi_static_step"), strict=True
    ):
        own = [row for row in CONVERGENCE if row["refinement"] == refinement]
        least = min(float(row["spacing"]) for row in own)
        found = [
            float(row[f"{name}_order"])
            for row in own
            if float(row["spacing"]) < 1.01 * least
            for name in QUANTITIES.values()
            if row[f"{name}_order"]
        ]
        assert len(found) >= 6
        assert cells[-1] == f"{min(found):.2f} to {max(found):.2f}"


@pytest.mark.slow
def test_reference_orders_are_measured_today(convergence):
    """To two digits of the errors: they are no round-off."""
    text = orders.to_csv(convergence)
    for now, stored in zip(csv.DictReader(io.StringIO(text)), CONVERGENCE, strict=True):
        for name in QUANTITIES.values():
            assert (now["problem"], now["refinement"]) == (stored["problem"], stored["refinement"])
            assert bool(now[name]) == bool(stored[name])
            if now[name]:
                assert float(now[name]) == pytest.approx(float(stored[name]), rel=5e-3)


def by_height():
    groups = defaultdict(list)
    for row in DISPERSION:
        groups[float(row["height"])].append({k: float(v) for k, v in row.items()})
    return groups


def test_bridge_is_that_of_the_reference():
    table, groups = rows("The bridge to the linear theory"), by_height()
    assert [float(row[0]) for row in table] == list(groups)
    for (_, kh, worst, crossing), (height, modes) in zip(table, groups.items(), strict=True):
        k = [mode["mode_wavenumber"] * height for mode in modes]
        assert kh == f"{min(k):.2f} to {max(k):.2f}"
        assert worst == f"{100 * max(mode['disagreement'] for mode in modes):.2f} %"
        assert crossing == f"{vanishing(modes):.4f}"


def test_bridge_of_two_layers_is_that_of_the_reference():
    """All far sides with either layer the stiffer one, six wavenumbers each, both directions."""
    modes = defaultdict(list)
    for row in reference("pair_modes.csv"):
        modes[row["id"]].append(row)
    table = rows("Two layers")
    assert [row[0] for row in table] == list(modes)
    for (_, kh, *worst), found in zip(table, modes.values(), strict=True):
        assert len(found) == 12
        k = [float(row["mode_wavenumber"]) * float(row["height"]) for row in found]
        assert kh == f"{min(k):.2f} to {max(k):.2f}"
        for branch, said in zip("01", worst, strict=True):
            errors = [float(row["disagreement"]) for row in found if row["branch"] == branch]
            assert said == f"{100 * max(errors):.2f} %"
            assert max(errors) < 5e-3  # 1 % is asked for


def vanishing(modes):
    """k / k_c where the faster mode's measured growth changes sign, by linear interpolation."""
    growth = defaultdict(list)
    for mode in modes:
        growth[mode["wavenumber_over_critical"]].append(mode["measured_growth"])
    ratio = np.array(sorted(growth))
    fastest = np.array([max(growth[r]) for r in ratio])
    i = np.flatnonzero(np.diff(np.sign(fastest)))[0]
    return ratio[i] + (ratio[i + 1] - ratio[i]) * fastest[i] / (fastest[i] - fastest[i + 1])
