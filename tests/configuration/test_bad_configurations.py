"""What is said about a bad configuration: every problem, with key, value, unit and range."""

import math

import pytest
from configurations import PAPER, assert_one_problem, changed, messages, with_run

from nucleation.configuration.load import load
from nucleation.model.quantities import ParameterError

NU = ["material.poisson_ratio", "Poisson's ratio", "(-1, 0.5)"]
RUN = "studies.paper.runs[6]"

BAD = {
    # out of range: key, value, unit, range
    "incompressible": (changed("material.poisson_ratio", 0.5), [*NU, "= 0.5"]),
    "nu below -1": (changed("material.poisson_ratio", -1.5), [*NU, "= -1.5"]),
    "no stiffness": (
        changed("material.shear_modulus", 0.0),
        ["material.shear_modulus = 0.0 Pa", "(0, 1e+13) Pa"],
    ),
    "negative density": (
        changed("material.density", -1200),
        ["material.density = -1200 kg/m^3", "[0, 1e+06) kg/m^3"],
    ),
    "tension": (changed("loading.normal_stress", -1e6), ["normal_stress = -1000000.0 Pa"]),
    "infinite stress": (changed("loading.normal_stress", math.inf), ["inf Pa", "(0, 1e+10)"]),
    "no velocity": (changed("loading.velocity", 0), ["loading.velocity = 0 m/s", "(0, 1)"]),
    "not a number": (changed("loading.velocity", math.nan), ["loading.velocity = nan m/s"]),
    "tolerance one": (changed("stepping.tolerance", 1.0), ["tolerance = 1.0", "(0, 1)"]),
    "negative time": (changed("stepping.end_time", -1), ["end_time = -1 s", "(0, 1e+12) s"]),
    "negative height": (with_run(height=-0.005), [f"{RUN}.height = -0.005 m", "(0, 1e+06) m"]),
    "zero height in list": (with_run(height=[0.01, 0]), [f"{RUN}.height[1] = 0 m"]),
    "zero mesh": (changed("studies.paper.defaults.n_x", 0), ["n_x = 0", "integer in [8, 100000]"]),
    "zero mesh in y": (with_run(height=0.01, n_y=0), [f"{RUN}.n_y = 0", "[2, 10000]"]),
    "grading below one": (with_run(height=0.01, grading=0.5), ["grading = 0.5", "[1, 1000]"]),
    "short block": (
        with_run(height=0.005, length=0.1),
        [f"{RUN}: length = 0.1 m", "critical nucleation length of the theory, 0.235 m"],
    ),
    "block not longer than L_c": (
        changed("studies.paper.length_over_critical", 1.0),
        ["studies.paper.length_over_critical = 1.0", "(1, 1000)"],
    ),
    "edge above V": (changed("extraction.edge_threshold", 1.5), ["edge_threshold", "(0, 1]"]),
    "negative inset": (changed("figures.inset_height", -1), ["figures.inset_height = -1 m"]),
    "zero curve height": (changed("curves.heights", [0.0, 0.1]), ["curves.heights[0] = 0.0 m"]),
    # wrong type
    "word for number": (changed("material.density", "heavy"), ["material.density = 'heavy'"]),
    "truth for number": (changed("material.density", True), ["material.density = True"]),
    "nothing for number": (changed("material.density", None), ["material.density = None"]),
    "list for number": (changed("material.density", [1200]), ["material.density = [1200]"]),
    "real mesh": (changed("studies.paper.defaults.n_x", 400.5), ["n_x = 400.5", "integer"]),
    "float mesh": (with_run(height=0.01, n_x=400.0), [f"{RUN}.n_x = 400.0", "integer"]),
    "number for text": (changed("results", 7), ["results = 7", "non-empty text"]),
    "empty results": (changed("results", ""), ["results = ''", "non-empty text"]),
    "section is a list": (changed("stepping", [1]), ["stepping = [1] must be a mapping"]),
    "section is empty": (changed("curves", None), ["curves = None must be a mapping"]),
    "runs are a mapping": (
        changed("studies.paper.runs", {"height": 0.1}),
        ["studies.paper.runs", "must be a list"],
    ),
    "text for text list": (
        with_run(height=0.01, evolution=["slip", 3]),
        [f"{RUN}.evolution[1] = 3"],
    ),
    "the whole is a list": ([1, 2], ["the configuration = [1, 2] must be a mapping"]),
    "the whole is empty": (None, ["the configuration = None must be a mapping"]),
    # unknown words
    "unknown state evolution": (
        with_run(height=0.01, evolution="ageing"),
        [f"{RUN}.evolution = 'ageing'", "aging, slip"],
    ),
    "unknown evolution": (changed("friction.evolution", "Slip"), ["evolution = 'Slip'", "slip"]),
    "unknown interface": (
        changed("studies.paper.interface", "both"),
        ["interface = 'both'", "one of main_text, friction_law"],
    ),
    "unknown section": (changed("materials", {}), ["materials = {}", "did you mean material?"]),
    "unknown key": (changed("material.densty", 1.0), ["material.densty", "mean density?"]),
    "unknown parameter": (with_run(heigth=0.1), [f"{RUN}.heigth = 0.1", "mean height?"]),
    "far from any key": (changed("loading.zzz", 1), ["loading.zzz = 1", "known keys: normal_st"]),
    "velocity twice": (
        changed("main_text_interface.velocity", 1e-5),
        ["main_text_interface.velocity", "unknown key"],
    ),
    "study's name": (changed("studies.a/b", {"runs": [{"height": 1}]}), ["'a/b'", "as a name"]),
    "name of a number": ({**PAPER, 3: 1}, ["[3] = 1 is not allowed: unknown key"]),
    # missing, empty, repeated, contradictory
    "no studies": ({"results": "results"}, ["the configuration lacks the key studies"]),
    "empty studies": (changed("studies", {}), ["studies = {} is empty"]),
    "no runs": (changed("studies.x", {}), ["studies.x lacks the key runs"]),
    "empty runs": (changed("studies.paper.runs", []), ["studies.paper.runs = [] is empty"]),
    "empty run": (with_run(), [f"{RUN} = {{}} is empty"]),
    "empty list": (with_run(height=[]), [f"{RUN}.height = [] is empty"]),
    "no height": (with_run(evolution="slip"), [f"{RUN}: the run has no height"]),
    "value twice": (with_run(height=[0.2, 0.2]), [f"{RUN}.height = [0.2, 0.2] has a value twice"]),
    "run twice": (
        with_run(height=0.05),
        [f"{RUN} gives the simulation paper-aging-H0.05-phi1 again", "runs[1]"],
    ),
    "same run, other name": (
        with_run(height=0.05, n_x=400),
        [f"{RUN} gives the simulation paper-aging-H0.05-phi1-n_x400 again"],
    ),
    "range without end": (
        with_run(height={"start": 0.1, "num": 3}),
        [f"{RUN}.height lacks the key stop"],
    ),
    "range of one": (
        changed("curves.f_beta", {"start": 0.0, "stop": 1.0, "num": 1}),
        ["curves.f_beta.num = 1", "integer in [2, 10000]"],
    ),
    "range backwards": (
        with_run(height={"start": 0.1, "stop": 0.01, "num": 3}),
        [f"{RUN}.height: start 0.1 must be less than stop 0.01"],
    ),
    "log range from zero": (
        changed("curves.f_beta", {"start": 0.0, "stop": 1.0, "num": 3, "scale": "log"}),
        ["curves.f_beta: start 0.0 must be positive on a log scale"],
    ),
    "unknown scale": (
        with_run(height={"start": 0.1, "stop": 1, "num": 3, "scale": "cubic"}),
        [f"{RUN}.height.scale = 'cubic'", "one of linear, log"],
    ),
    "range out of range": (
        with_run(height={"start": -0.1, "stop": 1, "num": 3}),
        [f"{RUN}.height.start = -0.1 m", "(0, 1e+06) m"],
    ),
    "mesh beyond the memory": (
        with_run(height=0.1, n_x=100000, n_y=10000),
        [f"{RUN}: n_x = 100000, n_y = 10000", "MB", "limits.memory = 2000 MB"],
    ),
    "too many runs": (
        with_run(
            height={"start": 0.1, "stop": 1, "num": 1000},
            phi0={"start": 1, "stop": 9, "num": 1000},
        ),
        [f"{RUN} stands for 1000000 simulations, more than 10000"],
    ),
    "nothing to nucleate": (
        changed("studies.x", {"runs": [{"height": 0.1, "aging_coefficient": 0.0}]}),
        ["studies.x.runs[0]:", "zeta"],
    ),
}


@pytest.mark.parametrize(("config", "fragments"), BAD.values(), ids=BAD.keys())
def test_bad_configuration_is_named(config, fragments):
    assert_one_problem(config, fragments)


def test_all_problems_are_reported_together():
    config = changed("material.poisson_ratio", 0.5)
    config["loading"]["velocity"] = "fast"
    config["studies"]["paper"]["runs"].append({"heigth": 0.1, "evolution": "none"})
    text = messages(config)
    assert text.startswith("the configuration has 4 problems:")
    for fragment in ("poisson_ratio", "velocity = 'fast'", "heigth", "evolution = 'none'"):
        assert fragment in text


@pytest.mark.parametrize(
    ("content", "fragments"),
    [
        ("a: 1\nb: 2\na: 3\n", ["key a stands twice", "lines 1 and 3"]),
        ("studies:\n  p: {runs: []}\n  p: {runs: []}\n", ["key p stands twice"]),
        ("material: {density: 1, density: 2}\n", ["key density stands twice"]),
        ("material: [\n", ["is not valid YAML"]),
        ("x: !!python/object/apply:os.getcwd []\n", ["is not valid YAML"]),
    ],
)
def test_bad_file_is_named(tmp_path, content, fragments):
    path = tmp_path / "config.yaml"
    path.write_text(content)
    with pytest.raises(ParameterError) as caught:
        load(path)
    for fragment in ["config.yaml", *fragments]:
        assert fragment in str(caught.value)


def test_missing_file_is_named(tmp_path):
    with pytest.raises(ParameterError, match=r"none\.yaml can't be read: No such file"):
        load(tmp_path / "none.yaml")
