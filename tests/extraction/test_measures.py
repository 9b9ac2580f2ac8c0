"""What is read from a simulation, on made-up records whose numbers are known."""

import numpy as np
import pytest
from made_up_runs import PARAMETERS, record

from nucleation.extraction.extraction import Record, extract
from nucleation.extraction.measures import (
    ALWAYS,
    BY_DEFINITION,
    MEASURES,
    _state_rate_well_approximated,
    measure,
)
from nucleation.model.friction import Friction

ONSET = 8.0  # s: the front has not come half-way along the block
VELOCITY = PARAMETERS.fault.velocity
STRESS = PARAMETERS.fault.normal_stress


def made_up(law="aging"):
    """The record of a front at constant speed, with the fields that measures need beside."""
    parameters = PARAMETERS.replaced(evolution=law)
    run = record(parameters=parameters, onset=ONSET)
    rate, time = run["slip_rate"], run["time"].values
    stress = 0.4 * STRESS * (rate > 0.1 * VELOCITY)
    normal = 0.0 * rate - STRESS * (1.0 - 0.2 * np.exp(-run["x"]))
    return run.assign(
        maximal_slip_rate=("step", rate.max("x").values),
        step_size=("step", np.diff(time, prepend=0.0)),
        state=0.03 + 0.0 * rate,
        shear_stress=stress,
        sigma_yy=normal,
    )


def test_numbers_of_a_steady_front():
    run = made_up()
    found = measure(Record(run))
    dx = PARAMETERS.block.length / PARAMETERS.block.n_x
    assert list(found) == list(MEASURES)
    lengths = extract(run)
    assert found["length_usual_start"] == lengths["length"]
    ends = [bound(found[name] for name in BY_DEFINITION) for bound in (min, max)]
    assert ends == [lengths["length_low"], lengths["length_high"]]
    assert found["front_speed"] == pytest.approx(dx / 0.1, rel=0.05)
    assert found["growth_time"] == pytest.approx(lengths["length"] / found["front_speed"])
    for end in ("", "_low", "_high"):
        assert found[f"patch_rate{end}"] == pytest.approx(VELOCITY)
    assert found["onset_rate"] == pytest.approx(VELOCITY)
    assert found["largest_rate"] == pytest.approx(800.0 * VELOCITY)
    assert found["rupture_time"] == pytest.approx(2e-3)  # two steps above 1 mm/s
    assert found["regular_share"] == pytest.approx(1.0, abs=0.03)
    opened = run.assign(sigma_yy=run["sigma_yy"].copy(deep=True))
    opened["sigma_yy"][-1, 5] = -0.1 * STRESS  # in the rupture
    later = measure(Record(opened))
    assert later["largest_normal_stress_ever"] == pytest.approx(-0.1 * STRESS)
    assert found["usual_step"] == pytest.approx(0.01)
    assert found["shortest_step"] == pytest.approx(1e-3)
    assert 0.0 < found["drop_time"] < 2.1e-3
    assert ONSET / found["drop_time"] > 1e3


@pytest.mark.parametrize(("slower", "time"), [(9.9, 2e-3), (10.1, np.nan)])
def test_ends_of_the_acceleration(slower, time):
    """From the onset on, which is two steps of 1 ms before the end."""
    run = made_up()
    fastest = run["maximal_slip_rate"].values.copy()
    fastest[-3:] = VELOCITY * np.array([slower, 50.0, 800.0])
    fastest[:-3] = VELOCITY
    found = measure(Record(run.assign(maximal_slip_rate=("step", fastest))))
    assert found["acceleration_time"] == pytest.approx(time, nan_ok=True)


def test_slip_law_needs_the_regularisation_where_nothing_slips():
    """Ahead of the front v = 1e-11 m/s, a hundredth of v0; in the patch v = 1e4 v0."""
    found = measure(Record(made_up("slip")))
    assert found["state_rate_share_patch"] > 0.95, "the patch alone: ahead of it, no point is"


def test_run_without_event_has_no_numbers_but_those_of_its_steps():
    run = made_up()
    quiet = run.assign(driving_force=("step", np.linspace(-1.0, -2.0, run.sizes["step"])))
    found = measure(Record(quiet))
    assert {name for name, value in found.items() if np.isfinite(value)} == set(ALWAYS)


REMOTE = {"loading": "remote", "stress_rate": 1.0}


@pytest.mark.parametrize("given", [{"record": "lengths"}, REMOTE])
def test_nothing_is_read_of_runs_of_other_kinds(given):
    """Their interface is not recorded, or the patch does not begin at x = 0."""
    run = made_up()
    assert measure(Record(run))
    other = run.assign_attrs(parameters=PARAMETERS.replaced(**given).to_json())
    assert measure(Record(other)) == {}


def test_a_rupture_slips_faster_than_a_millimetre_per_second():
    run = made_up()
    fastest = run["maximal_slip_rate"].values.copy()
    fastest[-2:] = [0.7e-3, 1.5e-3]
    found = measure(Record(run.assign(maximal_slip_rate=("step", fastest))))
    assert found["rupture_time"] == pytest.approx(run["step_size"].values[-1])


def test_the_patch_is_developed_from_half_of_the_onset_time_on():
    run = made_up()
    early = (run["time"] > 0.3 * ONSET) & (run["time"] < 0.45 * ONSET)
    faster = run["slip_rate"] * np.where(early, 3.0, 1.0)[:, None]
    found = measure(Record(run.assign(slip_rate=faster)))
    assert found["patch_rate_high"] == pytest.approx(VELOCITY)


@pytest.mark.parametrize(("rate", "error"), [(2.4, 0.077), (1.7, 0.138)])
def test_a_state_rate_is_well_approximated_within_a_tenth(rate, error):
    """For states so old that dphi/dt is -phi w/D, v for w is off by 1 - v/w."""
    friction = Friction(law="product")
    v0 = friction.regularisation_slip_rate
    assert 1.0 - rate / np.hypot(rate, 1.0) == pytest.approx(error, abs=1e-3)
    good = _state_rate_well_approximated(np.array([rate * v0]), np.array([1e7]), friction)
    assert good[0] == (error < 0.1)
