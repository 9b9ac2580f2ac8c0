"""``nucleation drop``: what it asks of the law, what it prints of the answer, what it refuses."""

import json
import math

import pytest

from nucleation.api import critical_length, stability_length
from nucleation.drop import expected_drop as module
from nucleation.drop.delay import ClosedForm, Drop
from nucleation.drop.expected_drop import ExpectedDrop
from nucleation.model.linearised import interface_state
from nucleation.model.perturbation import Perturbation
from nucleation.theory.critical import run_length
from nucleation.theory.status import NoLength

DROP = Drop(0.32, 0.31, 0.33, 14.0, 13.5, 14.5)
CLOSED = ClosedForm(0.25, 0.322, 0.014, 50.0, 1e-5)
WORDS = ("drop", "--height", "2cm", "--strength", "1e-4", "--second-body", "rigid")


class Law:
    """In place of the law of the drop: an answer, and what was asked for it."""

    answer = ExpectedDrop(0.25, DROP, CLOSED, "")

    def __call__(self, parameters):
        self.parameters = parameters
        if isinstance(self.answer, Exception):
            raise self.answer
        return self.answer


@pytest.fixture
def law(monkeypatch):
    made = Law()
    monkeypatch.setattr(module, "expected_drop", made)
    return made


def test_it_asks_for_the_fault_that_is_given(nucleation, law):
    assert nucleation(*WORDS, "--evolution", "slip", "--perturbation", "state").code == 0
    assert law.parameters.geometry.height == 0.02
    assert law.parameters.friction.evolution == "slip"
    assert law.parameters.perturbation == Perturbation("state", 1e-4)
    nucleation("drop", "--height", "2cm")
    assert law.parameters.perturbation == Perturbation("normal_load", 1e-4)


def test_scales_near_the_velocity_are_warned_of(nucleation, law):
    assert "friction changes" not in nucleation(*WORDS).err
    slow = nucleation(*WORDS, "--velocity", "1um/s")
    assert "slip_rate_scale = 1e-07 m/s" in slow.err and "with constant a and b 0.5" in slow.err
    of_b = ("--paper", "--velocity", "10nm/s", "--friction-law", "dieterich_ruina", "--a", "0.01")
    assert "b = 0.0" in (told := nucleation(*WORDS, *of_b).err) and "at V/10" in told
    others = ("--slip-rate-scale", "1e-10m/s", "--regularisation-slip-rate", "1e-12m/s")
    assert nucleation(*WORDS, "--velocity", "1um/s", *others).err == ""


def test_text(nucleation, law):
    ended = nucleation(*WORDS)
    assert (ended.code, ended.err) == (0, "")
    critical = run_length(law.parameters, interface_state(law.parameters))
    told = " ".join(ended.out.split())
    assert 0.4 < critical < 0.5 and f"L_c {critical:.4g} m" in told
    assert f"L_s 0.25 m {0.25 / critical:.3g} L_c" in told
    assert f"L 0.32 m {0.32 / critical:.3g} L_c" in told
    assert "0.31 m" in ended.out and "0.33 m" in ended.out and "13.5 to 14.5 s" in ended.out
    assert "normal_load, relative strength 0.0001, correlated over 1 D/V" in ended.out
    assert "docs/drop.md" in ended.out and "DO NOT" not in ended.out
    rough = nucleation(*WORDS, "--perturbation", "strength").out
    assert "strength, relative strength 0.0001, correlated over 2 cm" in rough
    law.answer = ExpectedDrop(0.25, DROP, CLOSED, "the perturbation is strong")
    assert "DO NOT RELY ON IT: the perturbation is strong." in nucleation(*WORDS).out


def test_json(nucleation, law):
    found = json.loads(nucleation(*WORDS, "--json").out)
    assert found["stability_length"] == 0.25
    assert (found["status"], found["reason"]) == ("value", "")
    assert found["drop"]["length"] == 0.32 and found["closed_form"]["effective"] == 1e-5
    assert found["trusted"] is True and found["doubt"] == ""
    assert found["perturbation"]["kind"] == "normal_load"


def test_a_stable_fault_is_told_with_its_system(nucleation, law):
    """And with a cure, where the law's own scales have stopped its weakening."""
    ended = nucleation(*WORDS, "--velocity", "1e-9m/s")
    assert ended.code == 3 and ended.out.startswith("System: a layer 2 cm high")
    assert "v0 = 1e-9 m/s, regularisation_slip_rate, must be far below V" in ended.out
    ended = nucleation(*WORDS, "--zeta", "-0.001", "--json")
    found = json.loads(ended.out)
    assert ended.code == 3 and found["theory"]["critical_length"] is None
    assert "sliding is stable" in found["reason"] and "v0" not in found["reason"]
    assert found["status"] == "stable"


@pytest.mark.parametrize("words", [(), ("--json",)])
def test_a_fault_that_the_law_does_not_reach(nucleation, law, words):
    law.answer = NoLength("no patch up to 3 L_c has a growing mode", "beyond")
    ended = nucleation(*WORDS, *words)
    assert ended.code == 4
    assert "no patch up to 3 L_c has a growing mode" in ended.out
    assert ('"status": "beyond"' in ended.out) == bool(words)


def test_it_answers_in_any_directory(nucleation, law, monkeypatch):
    """Nothing is written, so it does not matter whether a run could write its results there."""
    monkeypatch.chdir("/")
    assert nucleation(*WORDS).code == 0


@pytest.mark.slow
def test_ranges_and_samples_have_quantiles(nucleation, law, monkeypatch, tmp_path):
    """Each draw is a fault of its own, with a block of its own length."""
    from nucleation.drop import drop_quantiles

    seen = []

    def expected(parameters):
        seen.append(parameters)
        return law.answer

    monkeypatch.setattr(drop_quantiles, "expected_drop", expected)
    own = ("drop", "--strength", "1e-4", "--second-body", "rigid", "--draws", "20")
    ended = nucleation(*own, "--height", "2cm (1 to 4)", "--json")
    found = json.loads(ended.out)
    heights = [parameters.geometry.height for parameters in seen]
    assert ended.code == 0 and len(set(heights)) == 20 and 0.019 < sorted(heights)[10] < 0.022
    lengths = [p.geometry.length / run_length(p, interface_state(p)) for p in seen]
    assert lengths == pytest.approx([6.0] * 20, rel=1e-3)  # lengths are rounded
    assert (found["draws"], found["invalid"], found["uncertain"]) == (20, 0, ["height"])
    assert [one["key"] for one in found["lengths"]][-1] == "expected_length"
    path = tmp_path / "heights.csv"
    path.write_text("height (cm)\n1\n2\n4\n")
    text = nucleation(*own, "--samples", path).out
    assert "3 draws of height: 0 left out, 0 of the others stable" in text
    assert "length at the drop L" in text
    twice = nucleation(*WORDS, "--samples", path)
    assert twice.code == 2 and "height is given twice" in twice.err


OWN = (
    *("--shear-modulus", "30GPa", "--poisson-ratio", "0.25", "--normal-stress", "50MPa"),
    *("--a", "0.01", "--b", "0.015", "--slip-distance", "5um", "--friction", "0.6"),
    *("--velocity", "1um/s"),
)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("words", "high"),
    [
        ((), 4.0),
        (("--second-body", "60GPa,0.3"), 4.0),
        (("--second-body", "rigid"), 4.0),
        (("--plane", "antiplane"), 4.0),
        (("--height", "20cm", "--second-body", "60GPa,0.3,inf"), math.nan),
    ],
)
def test_half_spaces_are_blocks_of_a_stated_size_and_effect(nucleation, words, high):
    """L_s of the half-spaces is that of `length`, with the law that both commands have."""
    words = (*OWN, *(() if "--height" in words else ("--height", "inf")), *words)
    found = json.loads(nucleation("drop", *words, "--json").out)
    length = json.loads(nucleation("length", *words, "--json").out)["theory"]
    blocks = found["half_spaces"]
    assert blocks["stability_length"] == pytest.approx(length["stability_length"], rel=1e-9)
    difference = found["stability_length"] / blocks["stability_length"] - 1.0
    assert blocks["difference"] == pytest.approx(difference, abs=1e-6)
    assert abs(difference) < 0.02
    if not math.isnan(high):
        assert blocks["height"] == pytest.approx(high * length["critical_length"], rel=1e-3)
    assert f"computed as blocks {blocks['height']:.4g} m high" in " ".join(found["system"])


def test_a_simulation_of_half_spaces_resolves_the_process_zone(nucleation, tmp_path):
    """From a file too; the mesh is chosen unless it is given."""
    file = tmp_path / "fault.yaml"
    file.write_text("height: .inf\n")
    output = tmp_path / "run.nc"
    own = ("simulate", output, *OWN, "--memory", "10GB", "--dry-run")
    ended = nucleation(*own, "--parameters", file)
    assert ended.code == 0 and "Half-spaces: computed as blocks" in ended.out
    assert "mesh too coarse" not in ended.err
    coarse = nucleation(*own, "--height", "inf", "--n-x", "60")
    assert "mesh too coarse" in coarse.err


def test_uncertain_half_spaces(nucleation):
    words = [word for word in OWN if word not in ("--slip-distance", "5um")]
    uncertain = ("--slip-distance", "5um (3 to 10)", "--height", "inf", "--draws", "20")
    text = nucleation("drop", *words, *uncertain).out
    assert "Each draw has its own." in text and "length at the drop L" in text


@pytest.mark.slow
def test_such_a_block_has_the_patch_of_a_half_space():
    """L_s of weak and strong weakening, between bodies alike, on stiffer and rigid ones."""
    rock = {"shear_modulus": 30e9, "poisson_ratio": 0.25, "normal_stress": 50e6, "friction": 0.6}
    for zeta in (0.005, 0.023, 0.2):
        for second in (30e9, 60e9, math.inf):
            fault = rock | {"a": 0.01, "zeta": zeta, "slip_distance": 5e-6}
            fault["second_shear_modulus"] = second
            height = 4.0 * float(critical_length(**fault))
            block = float(stability_length(**fault, height=height))
            half_space = float(stability_length(**fault))
            assert block == pytest.approx(half_space, rel=0.02)
