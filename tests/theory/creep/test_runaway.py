"""L_run by theory: by an independent route, and how far it depends on how it is found."""

import dataclasses
import functools
import math
import re

import numpy as np
import pytest
from asked import stability_length
from docs.prose import page
from scipy.integrate import solve_ivp

from nucleation.api import Fault, Friction
from nucleation.run.run import PAPER_RUN
from nucleation.theory.creep import runaway, slow_slip
from nucleation.theory.creep.patches import Patches
from nucleation.theory.creep.runaway import runaway_answers
from nucleation.theory.evaluation import single_system
from nucleation.theory.status import BEYOND, NoLength

THIN = {
    "shear_modulus": 3.1e9,
    "poisson_ratio": 1.0 / 3.0,
    "normal_stress": 1e6,
    "a": 0.0068,
    "slip_distance": 5e-7,
    "second_shear_modulus": math.inf,
    "height": 1e-5,
    "friction": 0.0,
}
HALF_SPACES = {"second_shear_modulus": None, "height": math.inf, "friction": 0.41}
MOST_STEPS = 25_000  # of up to 64 patches at once: one to two seconds


def of_weakening(ratio, **changed):
    return THIN | {"zeta": ratio * 0.0068} | changed


BODIES = {
    "thin": {},
    "pair": HALF_SPACES | {"height": 0.02},
    "half-spaces": HALF_SPACES,
    "half-spaces-slip": HALF_SPACES | {"evolution": "slip"},
}


def over_critical(ratio, bodies, **changed):
    """L_run over L_c, and its error."""
    fault = Fault(**of_weakening(ratio, **BODIES[bodies] | changed))
    critical = float(fault.critical_length())
    patches = Patches(single_system(fault), evolution=fault.evolution)
    length, error = runaway.runaway_point(patches, critical)
    return length / critical, error


@functools.cache
def usual(ratio, bodies="thin"):
    """The same with the usual settings, and the steps that it takes."""
    steps, step = [], slow_slip._step
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(slow_slip, "_step", lambda *given: steps.append(1) or step(*given))
        return *over_critical(ratio, bodies), len(steps)


def runs_away_by_differences(ratio, length, nodes=40, duration=1500.0):
    """The thin strip by central differences: ``a v'/v + b phi'/phi = c (v - v_c)''``, v_c linear.

    `length` over L_c; with b phi'/phi of the aging law. ``(zeta/a) lambda = 4 pi^2`` at L_c.
    """
    y = (np.arange(nodes) + 1.0) / (nodes + 1.0)
    steady = y
    strength = ratio / (4.0 * np.pi**2 * length**2)  # stiffness over a
    second = (nodes + 1.0) ** 2 * (
        np.diag(np.full(nodes - 1, 1.0), -1)
        - 2.0 * np.eye(nodes)
        + np.diag(np.full(nodes - 1, 1.0), 1)
    )

    def rates(_, logs):
        v, log_state = np.exp(logs[:nodes]), logs[nodes:]
        aging = np.exp(-log_state) - v
        accelerating = strength * (second @ (v - steady)) - (1.0 + ratio) * aging
        return np.concatenate([accelerating, aging])

    def event(_, logs):
        return logs[:nodes].max() - math.log(300.0)

    event.terminal = True
    start = np.concatenate([np.log(steady), -np.log(steady)])
    start[nodes:] += 0.05 * np.sin(np.pi * y)
    found = solve_ivp(rates, (0.0, duration), start, "LSODA", rtol=1e-5, atol=1e-6, events=event)
    return bool(found.t_events[0].size)


@pytest.mark.answers
@pytest.mark.slow
@pytest.mark.parametrize(("ratio", "length"), [(0.2, 1.49), (0.5, 1.045), (1.5, 0.717)])
def test_thin_limit_by_two_routes(ratio, length):
    """Modes of a layer, explicitly; and finite differences of the strip, implicitly."""
    found, error, _ = usual(ratio)
    assert error < 0.05
    assert found == pytest.approx(length, rel=0.015)
    assert not runs_away_by_differences(ratio, 0.97 * found)
    assert runs_away_by_differences(ratio, 1.03 * found)


@pytest.mark.answers
@pytest.mark.parametrize(("ratio", "length", "its_error"), [(0.2, 3.1, 0.15), (0.5, 1.65, 0.05)])
def test_half_spaces_by_another_code(ratio, length, its_error):
    """Another code with 64 modes and its own error, in L_c; with 16 modes it is 2.57 at 0.2."""
    found, error, _ = usual(ratio, "half-spaces")
    assert abs(found - length) < its_error + error * found


ROW = r"\| ([\d.]+) \| ([\d.]+) \| ([\d.]+) \| ([\d.]+) % \|"
STATED = [tuple(map(float, row)) for row in re.findall(ROW, page("drop.md"))]


@pytest.mark.answers
@pytest.mark.slow
@pytest.mark.parametrize(("ratio", "thin", "half_spaces", "error"), STATED)
def test_the_page_states_lengths_within_their_error(ratio, thin, half_spaces, error):
    for bodies, stated in (("thin", thin), ("half-spaces", half_spaces)):
        found, own, _ = usual(ratio, bodies)
        assert stated == pytest.approx(found, rel=own)
    assert error == pytest.approx(100.0 * own, abs=0.5)


CHANGES = {
    "modes": {"FINENESS": 2 * slow_slip.FINENESS, "MODES_OF_ENDS": 2 * slow_slip.MODES_OF_ENDS},
    "longer": {"DURATION": 2.0 * runaway.DURATION, "MOST_STEPS": 2 * slow_slip.MOST_STEPS},
    "weaker": {"DISTURBANCES": (0.0025, 0.01)},
    "stronger": {"DISTURBANCES": (0.01, 0.04)},
    "tolerance": {"TOLERANCE": 0.1 * slow_slip.TOLERANCE},
    "event": {"FAST": 1000.0},
    "first step": {"FIRST_STEP": 0.1 * slow_slip.FIRST_STEP},
    "search": {"SOONER": 0.9, "SPACING": 1.04, "BRIEFLY": (12, 4)},
    "lengths": {"FIRST": (24, 4), "LAST": (10, 8), "REACH": 0.13, "PRECISION": 0.0},
    "widths": {"WIDTHS": (0.002, 0.1), "CLOSE": 3.0, "INSIDE": 0.6},
}


@pytest.mark.slow
@pytest.mark.parametrize(
    ("ratio", "bodies", "change"),
    [
        *((0.3, "half-spaces", change) for change in CHANGES),
        *((0.2, "pair", change) for change in list(CHANGES)[::2]),
        *((0.5, "thin", change) for change in list(CHANGES)[1::2]),
    ],
)
def test_it_does_not_depend_on_how_it_is_found(monkeypatch, ratio, bodies, change):
    """Within the errors of both lengths, which are two standard errors or more."""
    before, error, _ = usual(ratio, bodies)
    for name, value in CHANGES[change].items():
        module = runaway if hasattr(runaway, name) else slow_slip
        monkeypatch.setattr(module, name, value)
    after, its_error = over_critical(ratio, bodies)
    assert after == pytest.approx(before, rel=math.hypot(error, its_error))


@pytest.mark.parametrize("ratio", [0.2, 1.5])
@pytest.mark.parametrize("bodies", BODIES)
def test_what_it_costs(ratio, bodies):
    _, error, steps = usual(ratio, bodies)
    assert 0 < steps < MOST_STEPS
    assert 0.02 <= error < 0.12


def test_modes_follow_the_length_over_that_of_the_fronts():
    patches = Patches(single_system(Fault(**of_weakening(0.2, **HALF_SPACES))))
    cohesive = slow_slip.cohesive_wavenumber(patches, 1.0)
    numbers = [slow_slip.modes_that_resolve(cohesive, length) for length in (1.0, 2.0)]
    assert numbers[1] - slow_slip.MODES_OF_ENDS == pytest.approx(
        2 * (numbers[0] - slow_slip.MODES_OF_ENDS), abs=1
    )
    with pytest.raises(NoLength, match="modes"):
        slow_slip.modes_that_resolve(cohesive, 1e3)


@pytest.mark.parametrize(
    ("ratio", "bodies", "status", "reason"),
    [
        (-0.2, {}, "stable", "homogeneous sliding"),
        (0.03, {}, "unknown", "zeta/a = 0.03"),
        (2.1, {}, "unknown", "zeta/a = 2.1"),
        (0.5, {"loading": "remote"}, "unknown", "pushed at its edge"),
        (0.11, HALF_SPACES, "unknown", "modes"),
    ],
)
def test_a_fault_that_was_not_tried_has_its_reason(ratio, bodies, status, reason):
    length, error, own, why = runaway_answers(Fault(**of_weakening(ratio, **bodies)))
    assert np.isnan(length) and np.isnan(error)
    assert own == status and reason in str(why)


def test_slow_slip_that_lasts_has_no_runaway_length(monkeypatch):
    for name, value in {"LONGEST": 0.8, "BRIEFLY": (4, 2)}.items():
        monkeypatch.setattr(runaway, name, value)
    answer = runaway_answers(Fault(**of_weakening(0.5)))
    assert answer[2] == BEYOND and "L_c runs away" in str(answer[3])


def test_it_does_not_depend_on_how_numpy_treats_overflow():
    """Steps that are too long overflow, and are tried again."""
    with np.errstate(all="raise"):
        for bodies in ("half-spaces", "half-spaces-slip"):
            assert math.isfinite(over_critical(0.5, bodies)[0])
        assert math.isfinite(float(stability_length(**of_weakening(0.5))))


@pytest.mark.parametrize("width", [0.015, 0.03])
def test_the_transition_is_that_of_a_known_law(width):
    """Lengths about 2 m, and more of them on one side only, which must not draw the middle."""
    generator = np.random.default_rng(1)
    logs = np.append(np.repeat(np.linspace(-0.1, 0.1, 21), 200), np.full(2000, 0.02))
    runs = generator.random(logs.size) < 1.0 / (1.0 + np.exp(-logs / width))
    trials = runaway._Trials(2.0 * np.exp(logs), np.where(runs, 10.0, np.inf))
    middle, found, deviation = trials.transition()
    assert abs(middle - math.log(2.0)) < 3.0 * deviation < 0.2 * width
    assert found == pytest.approx(width, rel=0.1)


def test_a_sharp_transition_is_between_two_lengths():
    lengths = np.repeat([1.96, 1.98, 2.0, 2.02, 2.04], 4)
    times = np.where(lengths > 1.99, 10.0, np.inf)
    trials = runaway._Trials(lengths, times)
    assert trials.ends() == (1.98, 2.0)
    assert math.exp(trials.transition()[0]) == pytest.approx(1.99, rel=1e-3)


def last_bits(ratio, bodies, draw):
    """L_run over L_c and its error, of a modulus that differs in its last bits."""
    changed = {"shear_modulus": THIN["shear_modulus"] * (1.0 + draw * 2.0**-52)}
    return over_critical(ratio, bodies, **changed)


@pytest.mark.answers
@pytest.mark.slow
@pytest.mark.parametrize(
    ("ratio", "bodies"), [(0.2, "half-spaces"), (0.5, "half-spaces"), (0.2, "thin")]
)
def test_the_last_bits_of_a_modulus_hardly_change_it(ratio, bodies):
    """Less than half the error, which is the same; slow slip is chaotic, and each patch differs."""
    lengths, errors = np.transpose([last_bits(ratio, bodies, draw) for draw in range(5)])
    assert np.ptp(lengths) < 0.5 * errors[0] * lengths.mean()
    assert errors == pytest.approx(errors[0], rel=1e-6)


@pytest.mark.slow
@pytest.mark.parametrize("evolution", ["aging", "slip"])
def test_a_law_with_far_scales_has_constant_a_and_b(evolution):
    law = Friction(law="dieterich_ruina", evolution=evolution, regularisation_slip_rate=1e-14)
    friction = law.with_expansion(1e-5, 0.41, 0.0068, 0.0034)
    parameters = PAPER_RUN.replaced(height=0.02, block_length=4.0, friction_law=friction)
    own = parameters.patches
    constant = dataclasses.replace(own, law=None)
    found, _ = runaway.runaway_point(own, 1.0)
    expected, error = runaway.runaway_point(constant, 1.0)
    assert found == pytest.approx(expected, rel=error)


@pytest.mark.slow
@pytest.mark.parametrize(("ratio", "disturbed"), [(0.2, 1.12), (0.5, 0.91)])
def test_strong_disturbances_give_a_shorter_length(monkeypatch, ratio, disturbed):
    """Slow slip attracts weak perturbations of it, and not strong ones."""
    monkeypatch.setattr(runaway, "DISTURBANCES", (0.2, 0.2))
    monkeypatch.setattr(runaway, "SHORTEST", 0.6)
    assert over_critical(ratio, "thin")[0] == pytest.approx(disturbed, rel=0.02)
