"""``nucleation plot``: which faults it asks for, what it draws and refuses."""

import json

import numpy as np
import pytest

from nucleation import api
from nucleation.model.linearised import interface_state
from nucleation.theory.creep.lengths import stability_length_of
from nucleation.theory.critical import run_length

WORDS = ("plot", "out.png", "--second-body", "rigid", "--points", "3")
THEORY = ("--criterion", "critical", "--criterion", "stability")


@pytest.fixture(autouse=True)
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_lengths_over_a_height(nucleation, here):
    ended = nucleation(*WORDS, *THEORY, "--over", "height=5:50mm", "--specimen", "20cm", "--json")
    found = json.loads(ended.out)
    assert (ended.code, ended.err) == (0, "")
    (over,) = found["over"]
    assert (over["name"], over["units"]) == ("height", "mm")
    np.testing.assert_allclose(over["values"], [5.0, 50.0**0.5 * 5.0**0.5, 50.0])
    critical, patch = found["lengths"]
    heights = np.array(over["values"]) / 1000.0
    runs = [api.Parameters().replaced({"height": height}) for height in heights]
    expected = [run_length(run, interface_state(run)) for run in runs]
    np.testing.assert_allclose(critical["middle"], expected, rtol=1e-7)
    expected = [stability_length_of(*pair) for pair in zip(runs, expected, strict=True)]
    np.testing.assert_allclose(patch["middle"], expected, rtol=1e-6)
    assert (here / "out.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.slow
def test_draws_and_a_map(nucleation, here):
    """Bands of draws; a map of one length as PDF, with points that are stable."""
    range_of_stress = ("--normal-stress", "1MPa (0.5 to 2)", "--draws", "20")
    words = (*WORDS, *THEORY, "--over", "height=5mm:5cm", *range_of_stress)
    found = json.loads(nucleation(*words, "--json").out)
    low, middle, high = (np.array(found["lengths"][0][end]) for end in ("low", "middle", "high"))
    assert (low < middle).all() and (middle < high).all()
    over = ("--over", "height=5mm:5cm", "--over", "zeta-over-a=-0.5:2")
    ended = nucleation("plot", "map.pdf", "--second-body", "rigid", "--points", "4", *over)
    assert ended.code == 0 and (here / "map.pdf").read_bytes().startswith(b"%PDF")
    assert "No critical length L_c at 4 of 16 points: " in ended.out
    assert "friction does not weaken" in ended.out


@pytest.mark.slow
def test_the_drop_is_drawn_too(nucleation):
    found = json.loads(nucleation(*WORDS, "--over", "height=1cm:3cm", "--json").out)
    _, patch, drop = (np.array(one["middle"]) for one in found["lengths"])
    assert (drop > patch).all() and found["doubtful"] == [0.0] * 3
    assert (np.array(found["lengths"][2]["high"]) > drop).all()


def test_a_fault_that_is_stable_everywhere(nucleation, here):
    ended = nucleation(*WORDS, "--over", "height=1cm:3cm", "--zeta-over-a", "-0.5")
    assert ended.code == 3 and "No critical length L_c at 3 of 3 points" in ended.err
    assert not (here / "out.png").exists()


@pytest.mark.parametrize(
    "words, message",
    [
        (("--over", "height"), "must be NAME=LOW:HIGH"),
        (("--over", "hieght=1cm:2cm"), "did you mean height"),
        (("--over", "height=2cm:1cm"), "LOW must be below HIGH"),
        (("--over", "height=1s:2s"), "unit of time, but m"),
        (("--over", "height=1,5cm:2cm"), "write a decimal point, 1.5"),
        (("--over", "evolution=1:2"), "no range to draw over"),
        (("--over", "height=1cm:2cm", "--height", "1cm"), "height is given twice"),
        (("--over", "height=1cm:2cm",) * 2, "given twice for height"),
        (("--over", "height=1cm:2cm", "--over", "a=.01:.02", *THEORY), "more than once"),
        ((), "Missing option '--over'"),
    ],
)  # fmt: skip
def test_what_is_refused(nucleation, words, message):
    ended = nucleation(*WORDS, *words)
    assert ended.code == 2 and message in ended.err
    assert nucleation("plot", "out.jpg", "--over", "height=1cm:2cm").code == 2
