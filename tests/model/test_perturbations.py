"""Kinds of perturbations: one class has all that a kind is; with a part missing it is refused."""

import numpy as np
import pytest

from nucleation.api import PAPER
from nucleation.model.perturbations import KINDS, Kind, NormalLoad
from nucleation.model.quantities import ParameterError
from nucleation.run.run import PAPER_RUN
from nucleation.simulation.start import composed


@pytest.fixture(autouse=True)
def _kinds_of_before():
    """Kinds that a test defines go with it."""
    before = dict(KINDS)
    yield
    KINDS.clear()
    KINDS.update(before)


def test_flags_say_what_steps_and_mesh_must_resolve():
    flags = {name: (kind.in_time, kind.along_x) for name, kind in KINDS.items()}
    assert flags == {
        "drive_velocity": (True, False),
        "normal_load": (True, False),
        "strength": (False, True),
        "state": (True, True),
    }


@pytest.mark.parametrize(
    "missing", ["name", "noise", "in_time", "along_x", "begin", "imposed", "power"]
)
def test_a_kind_with_a_part_missing_is_refused_where_it_is_defined(missing):
    parts = {"name": "pulse", "noise": "by", "in_time": True, "along_x": False}
    parts |= {part: getattr(NormalLoad, part) for part in ("begin", "imposed", "power")}
    del parts[missing]
    with pytest.raises(ParameterError, match=f"perturbation Pulse .* lacks {missing}"):
        type("Pulse", (Kind,), parts)


def test_roughness_that_does_not_change_in_time_needs_no_power():
    parts = {"name": "cracks", "noise": "by", "in_time": False, "along_x": True}
    type("Cracks", (Kind,), parts | {p: getattr(NormalLoad, p) for p in ("begin", "imposed")})
    assert "cracks" in KINDS


@pytest.mark.parametrize("name", KINDS)
def test_what_a_kind_imposes_is_all_that_it_changes_of_the_drive(name):
    small = PAPER_RUN.replaced(n_x=8, n_y=2)
    steady = composed(small).drive.at(0.3)
    run = small.replaced(perturbation=name, strength=0.05)
    dynamics = composed(run)
    made = KINDS[name](run.perturbation, run.memory_time, 1e-5, dynamics.body.grid.x)
    found = dynamics.drive.at(0.3)
    for field, value in (steady._asdict() | made.imposed(0.3)).items():
        np.testing.assert_array_equal(getattr(found, field), value, err_msg=field)


def test_the_law_of_the_drop_takes_the_power_of_the_kind():
    """A load of twice the power has the L of one that is sqrt(2) times as strong."""

    class Doubled(NormalLoad):
        name = "doubled"
        noise = "under two loads, each by"

        @classmethod
        def power(cls, mode, declared):
            return 2.0 * super().power(mode, declared)

    fault = PAPER.replace(height=0.05)
    usual = fault.lengths("normal_load", np.sqrt(2.0) * 1.37e-4)["drop_length"]
    KINDS["normal_load"] = Doubled
    answered = fault.lengths("normal_load", 1.37e-4)
    assert "m) under two loads, each by 1.37e-4" in answered.sentence
    found = answered["drop_length"]
    assert found.value == pytest.approx(usual.value, rel=1e-9)
    assert found.value != pytest.approx(fault.lengths("state", 1.37e-4)["drop_length"].value)
