"""All commands ask for a fault in the same words, and say which fault they took it for."""

import json

import pytest
from asked import critical_length

from nucleation.api import PAPER
from nucleation.run.run import PAPER_RUN

FAULT = {
    "--shear-modulus": "30GPa",
    "--poisson-ratio": "0.25",
    "--normal-stress": "50MPa",
    "--a": "0.010",
    "--b": "0.015",
    "--slip-distance": "5um",
    "--friction": "0.6",
    "--velocity": "10um/s",
    "--height": "2m",
    "--second-shear-modulus": "20GPa",
    "--second-poisson-ratio": "0.3",
    "--second-height": "3m",
}
QUIET = ("--perturbation", "none")  # so that no length at the drop is worked out


def alone(fault):
    """The options without those of the second body."""
    return {k: v for k, v in fault.items() if not k.startswith("--second")}


def words(options):
    return [word for pair in options.items() for word in pair]


def theory(ended, key="critical_length"):
    """L_c, or another length, by `length` and by `simulate`."""
    found = json.loads(ended.out)
    if "theory" in found:
        return found["theory"][key]
    (entry,) = (entry for entry in found["lengths"] if entry["key"] == key)
    return entry["value"]


@pytest.mark.slow
def test_one_stability_length_in_all_commands(nucleation, tmp_path):
    """With the law's own a and b along the patch; v0 = 1e-2 V made the patch of `drop` longer."""
    sandstone = FAULT | {"--shear-modulus": "6GPa", "--normal-stress": "5MPa", "--height": "20cm"}
    law = ("--friction-law", "product", "--regularisation-slip-rate", "0.1um/s")
    fault = (*words(alone(sandstone)), *law, "--json")
    length = theory(nucleation("length", *fault, *QUIET), "stability_length")
    dry = nucleation("simulate", tmp_path / "x.nc", *fault, "--dry-run")
    assert theory(dry, "stability_length") == pytest.approx(length, rel=1e-8)


FOLLOWING = ("block_length", "end_time", "time_after_event", "correlation_length")
"""Parameters of a run that follow from the fault."""


def test_the_paper_fills_in_what_is_not_given(nucleation, tmp_path):
    usual = PAPER_RUN.to_dict()
    run = nucleation("simulate", tmp_path / "run.nc", "--paper", "--dry-run", "--json").out
    found = json.loads(run)["parameters"]
    assert found == pytest.approx(usual | {name: found[name] for name in FOLLOWING})
    paper = nucleation("length", "--paper", "--height", "2cm", *QUIET, "--json")
    assert theory(paper) == pytest.approx(PAPER.replace(height=0.02).critical_length(), rel=1e-12)
    assert "Not given, so the paper's: shear_modulus" in nucleation("length", "--paper", *QUIET).out
    assert "--paper" in nucleation("length", "--height", "2cm").err


def test_one_file_for_all_commands(nucleation, tmp_path):
    lines = [f"{k[2:].replace('-', '_')}: {v}" for k, v in FAULT.items()]
    lines += ["second_body: deformable", "friction_law: dieterich_ruina", "n_x: 200"]
    (file := tmp_path / "fault.yaml").write_text("\n".join(lines) + "\n")
    expected = float(
        critical_length(
            shear_modulus=30e9,
            poisson_ratio=0.25,
            normal_stress=50e6,
            a=0.01,
            b=0.015,
            slip_distance=5e-6,
            friction=0.6,
            height=2.0,
            second_shear_modulus=20e9,
            second_poisson_ratio=0.3,
            second_height=3.0,
        )
    )
    for command in (("length", *QUIET), ("simulate", tmp_path / "run.nc", "--dry-run")):
        ended = nucleation(*command, "--parameters", file, "--json")
        assert theory(ended) == pytest.approx(expected, rel=1e-3), ended.err
        doubled = nucleation(*command, "--parameters", file, "--normal-stress", "100MPa", "--json")
        assert theory(doubled) < 0.9 * expected  # an option is stronger


def test_another_law_has_the_scales_of_its_fault(nucleation, tmp_path):
    """Its v* was the paper's, which is that of V = 10 um/s; what is given stays."""
    fault = words(alone({**FAULT, "--velocity": "1um/s"}))
    law = ("--friction-law", "product", "--state-scale", "1e3s")
    found = nucleation("simulate", tmp_path / "run.nc", *fault, *law, "--dry-run", "--json")
    own = json.loads(found.out)["parameters"]
    assert own["slip_rate_scale"] == pytest.approx(1e-8) and own["state_scale"] == 1e3


SECOND = {
    (): "Second body: deformable, like the first.",
    ("--second-poisson-ratio", "0.25"): "second_poisson_ratio = 0.25",
    ("--second-height", "3m"): "Second body: deformable, like the first in all else.",
    ("--second-body", "rigid"): "Second body: rigid.",
}


@pytest.mark.parametrize("given", SECOND)
def test_a_command_names_the_second_body(nucleation, given):
    """A value given like the first body's was not in "Given", and a body like the first nowhere."""
    assert SECOND[given] in nucleation("length", *words(alone(FAULT)), *given, *QUIET).out


@pytest.mark.parametrize("law", ["none, a and b are constant", "dieterich_ruina", "product"])
def test_a_command_names_the_law_and_its_evolution(nucleation, law):
    own = alone(FAULT)
    given = ["--friction-law", law] if law == "product" else []
    if law.startswith("none"):
        own.pop("--velocity")
    out = nucleation("length", *words(own), *given, *QUIET).out
    (line,) = (line for line in out.splitlines() if line.startswith("Friction law: "))
    assert law in line and line.endswith("evolution: aging.")
