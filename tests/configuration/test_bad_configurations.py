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
    "infinite stress": (changed("loading.normal_stress", math.inf), ["inf Pa", "(0, 1e+10)"]),
    "not a number": (changed("loading.velocity", math.nan), ["loading.velocity = nan m/s"]),
    "zero height in list": (with_run(height=[0.01, 0]), [f"{RUN}.height[1] = 0 m"]),
    "zero mesh": (changed("studies.paper.defaults.n_x", 0), ["n_x = 0", "integer in [8, 100000]"]),
    "zero curve height": (changed("curves.heights", [0.0, 0.1]), ["curves.heights[0] = 0.0 m"]),
    # wrong type
    "truth for number": (changed("material.density", True), ["material.density = True"]),
    "real mesh": (changed("studies.paper.defaults.n_x", 400.5), ["n_x = 400.5", "integer"]),
    "empty results": (changed("results", ""), ["results = ''", "non-empty text"]),
    "section is empty": (changed("curves", None), ["curves = None must be a mapping"]),
    "runs are a mapping": (
        changed("studies.paper.runs", {"height": 0.1}),
        ["studies.paper.runs", "must be a list"],
    ),
    "the whole is a list": ([1, 2], ["the configuration = [1, 2] must be a mapping"]),
    "the whole is empty": (None, ["the configuration = None must be a mapping"]),
    # unknown words
    "unknown state evolution": (
        with_run(height=0.01, evolution="ageing"),
        [f"{RUN}.evolution = 'ageing'", "aging, slip"],
    ),
    "unknown section": (changed("materials", {}), ["materials = {}", "did you mean material?"]),
    "unknown key": (changed("material.densty", 1.0), ["material.densty", "mean density?"]),
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


def test_missing_file_is_named(tmp_path):
    with pytest.raises(ParameterError, match=r"none\.yaml can't be read: No such file"):
        load(tmp_path / "none.yaml")
