"""Exact restart: a run that goes on from a checkpoint ends like one that never stopped."""

import contextlib
import io
import os
import signal

import numpy as np
import pytest

from nucleation.model.perturbations import KINDS
from nucleation.model.quantities import ParameterError
from nucleation.run.run import PAPER_RUN
from nucleation.simulation.checkpoints import (
    EVERY,
    SIGNALS,
    VARIABLE,
    Stopped,
    _Checkpoint,
    interval,
)
from nucleation.simulation.run import simulate

COARSE = PAPER_RUN.replaced(
    height=0.005,
    block_length=0.9,
    n_x=60,
    n_y=6,
    grading=2.0,
    end_time=30.0,
    time_after_event=0.1,
    tolerance=5e-2,
    longest_step=0.25,
)
SHORT = PAPER_RUN.replaced(
    height=0.1,
    block_length=1.5,
    n_x=40,
    n_y=4,
    grading=2.0,
    end_time=0.5,
    tolerance=5e-2,
    longest_step=0.1,
)
SHAKEN = {"strength": 1e-2, "seed": 7}
PAIR = {"second_body": "deformable", "second_shear_modulus": 5e9, "second_n_y": 5}
RUNS = {
    "slip law": {"evolution": "slip"},
    "antiplane": {"plane": "antiplane"},
    **{kind: {"perturbation": kind, **SHAKEN} for kind in KINDS},
    **{side: {**PAIR, "second_far_side": side} for side in ("free", "clamped", "roller")},
    "remote": {
        "loading": "remote",
        "stress_rate": 2e5,
        "height": 0.5,
        "block_length": 3.0,
        "n_x": 61,
        "n_y": 6,
        "heterogeneity": "normal_stress",
        "change": -0.1,
        "width": 0.3,
        "perturbation": "drive_velocity",
        "strength": 1e-3,
    },
    "interface": {"record": "interface"},
    "lengths": {"record": "lengths"},
}


def checkpoint(path, fingerprint="this run", every=0.0):
    made = _Checkpoint(path, fingerprint)
    made._every = every
    return made


def loaded(path):
    """What a checkpoint of this run gives, and what is said of it."""
    with contextlib.redirect_stderr(io.StringIO()) as log:
        return checkpoint(path).load(), log.getvalue()


def kept_at(parameters, steps):
    """The undisturbed record, and the arrays offered after some of its steps."""
    offered = []

    def keep(arrays):
        offered.append(arrays() if len(offered) in steps else None)

    return simulate(parameters, keep=keep), offered


def assert_same(one, other):
    assert one.equals(other)
    for name in ("status", "completed", "steps", "rejected_steps", "parameters"):
        assert one.attrs[name] == other.attrs[name], name


@pytest.fixture(scope="module")
def whole():
    """A run through its event; stored before the first step, creeping and in the event."""
    steps = (0, 1, 2, 57, 400)
    record, offered = kept_at(COARSE, steps)
    in_event = int(np.argmax(record["maximal_slip_rate"].values))
    again, more = kept_at(COARSE, (in_event, record.sizes["step"] - 3))
    assert_same(record, again)
    return record, [arrays for arrays in offered + more if arrays is not None]


@pytest.mark.slow
def test_restart_is_exact_wherever_the_run_stops(whole, tmp_path):
    record, stored = whole
    assert [arrays["displacement"].ndim for arrays in stored] == [4, 4, 4, 2, 2, 4, 2]  # condensed
    for number, arrays in enumerate(stored):
        one = checkpoint(tmp_path / f"{number}.npz")
        one.keep(lambda arrays=arrays: arrays)
        assert_same(simulate(COARSE, start=one.load()), record)


@pytest.mark.parametrize("changes", RUNS.values(), ids=RUNS.keys())
def test_restart_is_exact_whatever_is_simulated(changes):
    record, offered = kept_at(SHORT.replaced(**changes), range(20))
    for arrays in (offered[0], offered[1], [one for one in offered if one is not None][-1]):
        assert_same(simulate(SHORT.replaced(**changes), start=arrays), record)


@pytest.mark.slow
@pytest.mark.parametrize("number", SIGNALS)
def test_signal_leaves_a_checkpoint_to_go_on_from(whole, tmp_path, number):
    record, _ = whole
    path = tmp_path / "run.npz"
    before = {n: signal.getsignal(n) for n in SIGNALS}
    steps = []

    def interrupt(instant):
        steps.append(instant)
        if len(steps) == 321:
            os.kill(os.getpid(), number)

    one = checkpoint(path, every=1e9)
    message = f"stopped by {number.name}; a further run resumes"
    with pytest.raises(Stopped, match=message), one.listening():
        simulate(COARSE, progress=interrupt, keep=one.keep)
    assert {n: signal.getsignal(n) for n in SIGNALS} == before, "a job hears of signals again"
    assert len(steps) == 321
    start, said = loaded(path)
    assert_same(simulate(COARSE, start=start), record)
    assert f"resumes from {path}" in said


def test_checkpoints_are_written_as_often_as_the_environment_has_it(tmp_path, monkeypatch):
    """Only how often: what a run is does not depend on it."""
    monkeypatch.delenv(VARIABLE, raising=False)
    assert interval() == EVERY == 60.0
    monkeypatch.setenv(VARIABLE, "0")
    assert interval() == 0.0
    for text in ("-1", "nan", "a minute"):
        monkeypatch.setenv(VARIABLE, text)
        with pytest.raises(ParameterError, match=f"{VARIABLE} = '{text}' is not allowed: a time"):
            _Checkpoint(tmp_path / "a.npz", "this run")
    monkeypatch.delenv(VARIABLE)
    one = checkpoint(tmp_path / "run.npz", every=1e9)
    one.keep(lambda: pytest.fail("it is not yet time"))
    assert not list(tmp_path.iterdir())
    two = checkpoint(tmp_path / "run.npz", every=0.0)
    for value in (np.array(1.0), np.array([[2, 3]]), np.array(True), np.empty(0)):
        two.keep(lambda value=value: {"value": value})
        np.testing.assert_array_equal(two.load()["value"], value, strict=True)


def test_checkpoint_of_another_run_is_refused(tmp_path):
    path = tmp_path / "run.npz"
    checkpoint(path, "another run").keep(lambda: {"value": np.array(1.0)})
    arrays, said = loaded(path)
    assert arrays is None
    assert "other code or parameters: the run starts at the beginning" in said
    assert checkpoint(tmp_path / "none.npz").load() is None


@pytest.mark.slow
def test_no_damage_goes_unnoticed(tmp_path):
    """Bits flipped and ends cut off anywhere: refused with a message, or without effect."""
    path = tmp_path / "run.npz"
    arrays = {"numbers": np.random.default_rng(2).random(60), "count": np.array(3)}
    checkpoint(path).keep(lambda: arrays)
    whole = path.read_bytes()
    damaged = [whole[:length] for length in range(0, len(whole), 7)]
    for place in range(len(whole)):
        flipped = bytearray(whole)
        flipped[place] ^= 1 << (place % 8)
        damaged.append(bytes(flipped))
    refused = 0
    for content in damaged:
        path.write_bytes(content)
        found, said = loaded(path)
        if found is None:
            refused += 1
            assert "the run starts at the beginning" in said
        else:
            np.testing.assert_equal(found, arrays)
    assert refused > 0.5 * len(damaged)  # the rest hit what carries no meaning, such as dates


def test_pickled_checkpoint_is_not_executed(tmp_path):
    path = tmp_path / "run.npz"
    np.savez(path, fingerprint=np.array("this run"), value=np.array([{"a": 1}], dtype=object))
    arrays, said = loaded(path)
    assert arrays is None and "damaged" in said
