"""The time left of many runs, on made-up schedules whose end is known."""

import heapq

import numpy as np
import pytest

from nucleation.model.parameters import Parameters
from nucleation.pipeline.time_left import (
    TimeLeft,
    expected_steps,
    mean_of_censored,
    predicted_cost,
)
from nucleation.theory.estimates import growth_time

RUNS = 400


def relative_errors(costs, durations, slots, gap=0.0, parts=(0.1, 0.3, 0.6, 0.9)):
    """Errors of the time left after some parts of the runs, over the time that was left.

    Each slot works through runs in their order, with a gap before each.
    """
    slot_free, events = [0.0] * slots, []
    for i, duration in enumerate(durations):
        begin = heapq.heappop(slot_free) + gap
        heapq.heappush(slot_free, begin + duration)
        events += [(begin, True, str(i)), (begin + duration, False, str(i))]
    left, last = TimeLeft({str(i): cost for i, cost in enumerate(costs)}), max(events)[0]
    done, errors, wanted = 0, [], [int(part * len(durations)) for part in parts]
    for moment, begins, name in sorted(events):
        (left.begins if begins else left.ends)(name, moment)
        told, done = left.seconds(moment), done + (not begins)
        if not begins and done in wanted:
            errors.append(abs(told / (last - moment) - 1.0))
    assert len(errors) == len(parts)
    return errors


SCHEDULES = [(1, 0.0), (2, 0.0), (2, 0.7), (8, 0.1), (37, 0.0)]


@pytest.mark.parametrize(("slots", "gap"), SCHEDULES)
def test_equal_runs(slots, gap):
    errors = relative_errors([1.0] * RUNS, [2.0] * RUNS, slots, gap)
    assert max(errors[:3]) < 0.15


@pytest.mark.parametrize(("slots", "gap"), SCHEDULES)
@pytest.mark.parametrize("seed", range(5))
def test_random_durations(slots, gap, seed):
    durations = np.random.default_rng(seed).lognormal(0.0, 0.5, RUNS)
    assert max(relative_errors([1.0] * RUNS, durations, slots, gap)[:2]) < 0.3


@pytest.mark.parametrize(("slots", "gap"), SCHEDULES)
def test_predicted_costs_that_vary_with_the_order(slots, gap):
    costs = np.geomspace(1.0, 30.0, RUNS)
    noise = np.random.default_rng(1).lognormal(0.0, 0.3, RUNS)
    assert max(relative_errors(costs, 0.5 * costs * noise, slots, gap)[:2]) < 0.3
    unknown = relative_errors([1.0] * RUNS, 0.5 * costs * noise, slots, gap)
    assert unknown[0] > 0.5, "without the prediction it is far off: the prediction is used"


def test_nothing_is_said_before_a_run_has_ended():
    left = TimeLeft({"a": 1.0, "b": 1.0})
    assert left.seconds(0.0) is None
    left.begins("a", 0.0)
    assert left.seconds(5.0) is None and left.running == 1
    left.ends("a", 10.0)
    assert left.seconds(10.0) == pytest.approx(10.0)
    left.begins("b", 10.0)
    assert left.seconds(14.0) == pytest.approx(6.0)
    assert left.seconds(25.0) == 0.0, "it takes longer than expected, and may end at once"


def test_a_run_that_failed_or_was_there_is_not_waited_for():
    left = TimeLeft(dict.fromkeys("abc", 1.0))
    left.begins("a", 0.0)
    left.ends("a", 4.0)
    left.ends("b", 4.0)  # taken from a cache: not seen to begin
    assert left.seconds(4.0) == pytest.approx(4.0)
    left.ends("b", 5.0)
    left.begins("b", 6.0)
    assert left.running == 0, "what has ended has ended"


def test_cost_grows_with_mesh_and_steps():
    base, length = Parameters(), 0.3
    cost = predicted_cost(base, length)
    fine = base.replaced({"mesh.n_x": 2 * base.mesh.n_x})
    assert predicted_cost(fine, length) / cost == pytest.approx(2.0**0.72)
    assert predicted_cost(base.replaced({"n_y": 2 * base.mesh.n_y}), length) > cost
    short = base.replaced({"longest_step": 0.5 * base.stepping.longest_step})
    assert predicted_cost(short, length) / cost == pytest.approx(2.0)


def test_steps_are_those_until_the_patch_is_unstable():
    """Or to the end, where that is sooner or there is no instability."""
    base = Parameters().replaced({"end_time": 1e3, "longest_step": 0.1})
    step = 0.1 * base.memory_time
    until = growth_time(base, 0.55 * 0.3)
    assert expected_steps(base, 0.3) == pytest.approx(until / step)
    assert expected_steps(base, 0.6) > 2.0 * expected_steps(base, 0.3)
    assert expected_steps(base, float("nan")) == pytest.approx(1e3 / step)
    ended = base.replaced({"end_time": 0.5 * until})
    assert expected_steps(ended, 0.3) == pytest.approx(0.5 * until / step)


def test_mean_of_censored_values():
    """The example of Kaplan and Meier (1958, section 1): deaths at 0.8, 3.1, 5.4, 9.2, losses at
    1.0, 2.7, 7.0, 12.1; the survival falls to 7/8, 7/10, 21/40, 21/80."""
    deaths, losses = np.array([0.8, 3.1, 5.4, 9.2]), np.array([1.0, 2.7, 7.0, 12.1])
    steps = [1 / 8, 7 / 8 - 7 / 10, 7 / 10 - 21 / 40, 21 / 80, 21 / 80]
    expected = np.dot(steps, [*deaths, 12.1])
    assert mean_of_censored(deaths, np.ones(4), losses, np.ones(4)) == pytest.approx(expected)
    assert mean_of_censored(deaths, np.ones(4), losses[:0], losses[:0]) == deaths.mean()
    assert mean_of_censored(deaths, np.arange(4.0), np.array([0.1]), np.ones(1)) == pytest.approx(
        np.average(deaths, weights=np.arange(4.0))
    )
