"""All commands ask for a fault in the same words, and say which fault they took it for."""

import json

import pytest

from nucleation.api import Parameters, critical_length

FAULT = {
    "--shear-modulus": "30GPa", "--poisson-ratio": "0.25", "--normal-stress": "50MPa",
    "--a": "0.010", "--b": "0.015", "--slip-distance": "5um", "--friction": "0.6",
    "--velocity": "10um/s",
    "--height": "2m", "--second-body": "20GPa,0.3,3m",
}  # fmt: skip
OTHER_WORDS = {
    "--a": "--direct-effect",
    "--friction": "--friction",
    "--poisson-ratio": "--poisson-ratio",
    "--slip-distance": "--slip-distance",
    "--height": "--geometry.height",
}


def words(options):
    return [word for pair in options.items() for word in pair]


def expected():
    return float(critical_length(
        shear_modulus=30e9, poisson_ratio=0.25, normal_stress=50e6, a=0.01, b=0.015,
        slip_distance=5e-6, friction=0.6, height=2.0, second_shear_modulus=20e9,
        second_poisson_ratio=0.3, second_height=3.0,
    ))  # fmt: skip


def theory(ended):
    return json.loads(ended.out)["theory"]["critical_length"]


@pytest.mark.slow
def test_one_fault_in_the_same_words_for_all_commands(nucleation, tmp_path):
    other = {OTHER_WORDS.get(word, word): value for word, value in FAULT.items()}
    for options in (FAULT, other):
        assert theory(nucleation("length", *words(options), "--json")) == pytest.approx(expected())
        run = [*words(options), "--friction-law", "dieterich_ruina", "--json"]
        dry = nucleation("simulate", tmp_path / "run.nc", *run, "--dry-run")
        assert theory(dry) == pytest.approx(expected(), rel=1e-3), dry.err
        assert theory(nucleation("drop", *run)) == pytest.approx(expected(), rel=1e-3)
    asked = {k: v for k, v in FAULT.items() if k != "--normal-stress"}
    fit = nucleation("specimen", "--length", f"{expected()}m", *words(asked), "--json")
    assert json.loads(fit.out)["intervals"][0][0] == pytest.approx(50e6, rel=1e-3)


@pytest.mark.slow
@pytest.mark.parametrize(
    "more",
    [
        (),
        ("--evolution", "slip"),
        ("--friction-law", "product"),
        ("--velocity", "1mm/yr"),
        ("--friction-law", "product", "--regularisation-slip-rate", "0.1um/s"),
    ],
    ids=" ".join,
)
def test_one_stability_length_in_all_commands(nucleation, tmp_path, more):
    """With the law's own a and b along the patch; v0 = 1e-2 V made the patch of `drop` longer."""
    sandstone = words({
        "--shear-modulus": "6GPa", "--poisson-ratio": "0.25", "--normal-stress": "5MPa",
        "--a": "0.010", "--b": "0.015", "--slip-distance": "5um", "--friction": "0.6",
        "--velocity": "10um/s",
        "--height": "20cm",
    })  # fmt: skip
    fault = (*sandstone, *more, "--json")
    length = json.loads(nucleation("length", *fault).out)["theory"]["stability_length"]
    dry = json.loads(nucleation("simulate", tmp_path / "x.nc", *fault, "--dry-run").out)
    assert dry["theory"]["stability_length"] == pytest.approx(length, rel=1e-8)
    drop = json.loads(nucleation("drop", *fault).out)
    assert drop["stability_length"] == pytest.approx(length, rel=1e-8)
    assert drop["closed_form"]["front_length"] == pytest.approx(length, rel=0.06)


def test_one_fault_in_antiplane_shear(nucleation, tmp_path):
    """BP1: 3221 m of half-spaces; friction and Poisson's ratio do not matter."""
    fault = words({
        "--shear-modulus": "32.04GPa", "--poisson-ratio": "0.25", "--normal-stress": "50MPa",
        "--a": "0.010", "--b": "0.015", "--slip-distance": "8mm", "--velocity": "1nm/s",
        "--friction": "0.6", "--plane": "antiplane", "--height": "30km",
    })  # fmt: skip
    for command in (("length",), ("drop",), ("simulate", tmp_path / "run.nc", "--dry-run")):
        ended = nucleation(*command, *fault, "--json")
        assert theory(ended) == pytest.approx(3221, abs=1), ended.err
    assert "antiplane shear, with mu* = mu" in nucleation("length", *fault).out
    rollers = nucleation("length", *fault, "--far-side", "roller")
    assert rollers.code == 2 and "one of velocity, traction, free, clamped" in rollers.err


def test_a_fault_of_its_own_has_scales_of_its_own(nucleation, tmp_path):
    """The paper's v*, v0, phi*, age and correlation length are those of V = 10 um/s, D = .5 um."""
    fault = {**FAULT, "--velocity": "1mm/yr", "--friction": "0.65", "--height": "5m"}
    fault = words({k: v for k, v in fault.items() if k != "--second-body"})
    ended = nucleation("drop", *fault, "--json")
    assert json.loads(ended.out)["theory"]["critical_length"] == pytest.approx(2.513, rel=1e-2)

    def planned(*more):
        found = nucleation("simulate", tmp_path / "run.nc", *fault, *more, "--dry-run", "--json")
        return json.loads(found.out)["parameters"]

    own = planned("--perturbation", "strength")
    velocity, memory = own["loading"]["velocity"], 5e-6 / own["loading"]["velocity"]
    friction = own["friction"]
    assert friction["law"] == "dieterich_ruina"
    assert friction["log_rate_coefficient"] == pytest.approx(0.010)
    assert friction["log_state_coefficient"] == pytest.approx(0.015, rel=1e-6)
    assert friction["reference_slip_rate"] == velocity
    assert friction["regularisation_slip_rate"] == pytest.approx(1e-4 * velocity)
    assert own["loading"]["initial_state"] == pytest.approx(20.0 * memory)
    zone = 30e9 / 0.75 * 5e-6 / (0.015 * 50e6)
    assert own["perturbation"]["correlation_length"] == pytest.approx(0.2 * zone)
    product = planned("--friction-law", "product", "--state-scale", "1e3s")["friction"]
    assert product["slip_rate_scale"] == pytest.approx(1e-2 * velocity)
    assert product["state_scale"] == 1e3, "what is given stays"


def test_the_paper_fills_in_what_is_not_given(nucleation, tmp_path):
    usual = Parameters().to_dict()
    run = nucleation("simulate", tmp_path / "run.nc", "--paper", "--dry-run", "--json").out
    found = json.loads(run)["parameters"]
    for group in ("material", "friction", "second_body", "perturbation"):
        assert found[group] == usual[group]
    assert found["loading"] == usual["loading"]
    lengths = [
        json.loads(nucleation(command, "--paper", "--height", "2cm", "--json").out)
        for command in ("length", "drop")
    ]
    critical, drop = (found["theory"]["critical_length"] for found in lengths)
    assert critical == pytest.approx(drop, rel=1e-9)
    assert lengths[0]["theory"]["stability_length"] == pytest.approx(lengths[1]["stability_length"])
    assert "Not given, so the paper's: shear_modulus" in nucleation("length", "--paper").out
    assert "--paper" in nucleation("length", "--height", "2cm").err


def test_what_is_assumed_of_the_second_body_is_told_by_all(nucleation, tmp_path):
    """A second body without a height is as high as the first, whichever command is asked."""
    for body, assumed in (("35GPa,0.25", "as high as the first"), ("same", "like the first")):
        fault = words({**FAULT, "--second-body": body})
        for command in (("length",), ("drop",), ("simulate", tmp_path / "run.nc", "--dry-run")):
            told = " ".join(nucleation(*command, *fault).out.split())
            assert f"Assumed: the second body is {assumed}" in told, command


def test_one_file_for_all_commands(nucleation, tmp_path):
    lines = [f"{k[2:].replace('-', '_')}: {v}" for k, v in FAULT.items() if k != "--second-body"]
    lines += ["second_body: 20GPa,0.3,3m", "friction_law: dieterich_ruina", "n_x: 200"]
    (file := tmp_path / "fault.yaml").write_text("\n".join(lines) + "\n")
    for command in (("length",), ("drop",), ("simulate", tmp_path / "run.nc", "--dry-run")):
        ended = nucleation(*command, "--parameters", file, "--json")
        assert theory(ended) == pytest.approx(expected(), rel=1e-3), ended.err
    doubled = nucleation("length", "--parameters", file, "--normal-stress", "100MPa", "--json")
    assert theory(doubled) < 0.9 * expected()  # an option is stronger


@pytest.mark.parametrize("text", ["same", "deformable"])
def test_bodies_alike(nucleation, text):
    alone = words({k: v for k, v in FAULT.items() if k != "--second-body"})
    assert nucleation("length", *alone, "--second-body", text) == nucleation("length", *alone)


@pytest.mark.slow
def test_two_bodies_are_the_usual_system_everywhere(nucleation, tmp_path):
    fault = ("--height", "2cm")
    for command in (("drop",), ("simulate", tmp_path / "run.nc", "--dry-run")):
        alike = nucleation(*command, *fault).out
        assert "System: two identical bodies, each a layer 2 cm" in alike
        rigid = nucleation(*command, *fault, "--second-body", "rigid").out
        assert "a layer 2 cm high with its far side free" in rigid and "on a rigid one" in rigid
        papers = "shear_modulus, poisson_ratio, normal_stress, velocity, slip_distance, friction."
        assert papers in nucleation(*command, *fault, "--a", "0.01", "--b", "0.02").out
    given = {k: v for k, v in FAULT.items() if k not in ("--height", "--second-body")}
    told = " ".join(nucleation("length", *words(given)).out.split())
    assert "two identical bodies, each a half-space" in told
    other = nucleation("length", *words(FAULT | {"--second-body": "25GPa,0.25,inf"})).out
    assert "a layer 2 m high" in other and "on a half-space (mu" in other
    assert "Assumed: the second body is like the first, half-spaces, plane strain." in told


def test_lengths_of_half_spaces_are_not_called_valid_of_layers(nucleation):
    same = {k: v for k, v in FAULT.items() if k != "--second-body"}
    out = nucleation("length", *words(same)).out
    part = out.partition("two identical half-spaces of")[2].partition("in use, for a layer")[0]
    assert "for half-spaces (here H = 2 m)" in part and " valid:" not in part
    high = {k: v for k, v in same.items() if k != "--height"}
    assert "valid: velocity weakening" in nucleation("length", *words(high)).out
