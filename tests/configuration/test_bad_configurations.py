"""What is said about a bad configuration: every problem, with key, value, unit and range."""

import os

import pytest
from configurations import assert_one_problem, changed, messages, study, with_run

from nucleation.fault.files import read_yaml
from nucleation.model.quantities import ParameterError
from replication.configuration.checks import directory_problem
from replication.configuration.load import configure

RUN, LAST = "studies.s.runs[0]", "studies.paper.runs[6]"
THOUSAND = {"start": 1, "stop": 9, "num": 1000}
TALL = {"height": 0.1}
RIGID = "is not allowed with second_body = rigid"
BAD = [
    # out of range: key, value, unit, range
    (changed("material.poisson_ratio", 0.5), ["poisson_ratio = 0.5", "s ratio", "(-1, 0.5)"]),
    (with_run(height=[0.01, 0]), [f"{LAST}.height[1] = 0 m"]),
    # wrong type
    (changed("studies.paper.runs", {"height": 0.1}), ["studies.paper.runs", "must be a list"]),
    (None, ["the configuration = None must be a mapping"]),
    # unknown words
    (with_run(height=0.01, evolution="ageing"), [f"{LAST}.evolution = 'ageing'", "aging, slip"]),
    (changed("material.densty", 1.0), ["densty", "mean density?"]),
    (changed("studies.a/b", {"runs": [{"height": 1}]}), ["'a/b'", "as a name"]),
    # missing, empty, repeated, contradictory
    (changed("studies", {}), ["studies = {} is empty"]),
    (with_run(evolution="slip"), [f"{LAST}: the run has no height"]),
    (with_run(height=[0.2, 0.2]), [f"{LAST}.height = [0.2, 0.2] has a value twice"]),
    (
        with_run(height=0.05, n_x=400),
        [f"{LAST} gives the simulation paper-aging-H0.05-phi1-n_x400 again"],
    ),
    (
        with_run(height={"start": 0.1, "stop": 0.01, "num": 3}),
        [f"{LAST}.height: start 0.1 must be less than stop 0.01"],
    ),
    (
        changed("curves.f_beta", {"start": 0.0, "stop": 1.0, "num": 3, "scale": "log"}),
        ["curves.f_beta: start 0.0 must be positive on a log scale"],
    ),
    (study({**TALL, "strength": 1e-3}), [f"{RUN}: strength = 0.001 is", "perturbation one of"]),
    (
        study({**TALL, "perturbation": "strength", "strength": 1e-3, "correlation_length": 1e-4}),
        [f"{RUN}: correlation_length = 0.0001 m is not allowed", "at least an element"],
    ),
    (
        with_run(height=0.1, n_x=100000, n_y=10000),
        [f"{LAST}: n_x = 100000, n_y = 10000", "MB", "limits.memory = 2000 MB"],
    ),
    (
        with_run(height=THOUSAND, initial_state=THOUSAND),
        [f"{LAST} has 1000000 simulations, more than 10000"],
    ),
    (
        changed("studies.x", {"runs": [{"height": 0.1, "aging_coefficient": 0.0}]}),
        ["studies.x.runs[0]:", "zeta"],
    ),
    # beyond what a number can be, or a list
    (
        study({**TALL, "velocity": [[1e-5]]}),
        [f"{RUN}.velocity[0] = [1e-05] m/s", "[1e-30, 1000) m/s"],
    ),
    (
        changed("curves.heights", {"start": 0.1, "stop": 0.1 + 1e-9, "num": 50}),
        ["curves.heights: its 50 values from 0.1 on are not all different"],
    ),
    # names and places
    ({"studies": {True: {"runs": [TALL]}}}, ["studies: True", "as a name"]),
    (
        study(
            TALL
            | {
                "slip_distance": 5e-7,
                "regularisation_slip_rate": 1e-9,
                "shear_modulus": 3.2e9,
                "initial_stress": "uniform_shear",
                "initial_shear_stress": 1.0,
                "rate_coefficient": 0.005,
                "aging_coefficient": 0.075,
                "slip_rate_scale": 1e-7,
                "time_after_event": 0.0,
            }
        ),
        [f"{RUN}: s-aging-H0.1", "characters, more than 200"],
    ),
    (changed("results", "out/{x}"), ["results = 'out/{x}'", "named without braces"]),
    (changed("results", "results/../src"), ["results = 'src'", "code that makes results"]),
    (changed("results", "a/.."), ["results = '.'", "of its own"]),
    (changed("results", "a\nb"), ["results = 'a\\nb'", "control characters"]),
    (changed("results", ".git/hooks"), ["results = '.git/hooks'", "neither hidden"]),
    (changed("results", "~/out"), ["results = '~/out'", "wildcards, ~"]),
    # contradictions
    (
        changed("extraction.edge_threshold_low", 0.1),
        ["edge_threshold_low = 0.1, edge_threshold = 0.01", "must ascend, each in (0, 1]"],
    ),
    (
        study(TALL | {"event_drop": 0.05}) | {"extraction": {"drop": 0.1}},
        ["event_drop = 0.05 is not allowed with extraction.drop = 0.1"],
    ),
    (
        study(TALL, defaults={"shortest_step": 0.5}),
        [f"{RUN}: shortest_step = 0.5 s", "than the first step, 1e-07 s", "D/V = 0.005 s"],
    ),
    (
        {
            "friction": {"aging_coefficient": 0.0},
            **study({"height": [0.005, 0.1], "block_length": 3.0}, role="paper"),
        },
        ["zeta = -0.005 with a = 0.005 is not allowed", "an instability at H = "],
    ),
    # names
    (with_run(height=0.1, length=2.0), [f"{LAST}.length = 2.0", "did you mean block_length?"]),
    (
        with_run(height=0.1, friction_law="aging"),
        [f"{LAST}.friction_law = 'aging'", "one of dieterich_ruina, product", "called evolution"],
    ),
    (
        {
            **study({"height": 0.1}),
            "friction": {"friction_law": "dieterich_ruina", "state_scale": 1.0},
        },
        [
            "state_scale = 1.0 is not allowed: the friction law dieterich_ruina has no such",
            "log_rate_coefficient",
        ],
    ),
    # roles
    (study(TALL, role="maps"), ["studies.s.role = 'maps'", "one of own, paper"]),
    (
        study(TALL, role="map", runs_per_job=2),
        ["studies.s.measure = lengths is not allowed with role = map: it must be stability"],
    ),
    (
        study(TALL, role="converged", table="own"),
        ["studies.s.table = own is not allowed with role = converged: it must be lengths"],
    ),
    (
        study(TALL | {"record": "lengths"}, role="converged"),
        ["studies.s: s-aging-H0.1-phi1-recordlengths: record = lengths is", "must be interface"],
    ),
    (
        study(TALL, TALL | {"perturbation": "state", "strength": 1e-3}, role="convergence_quiet"),
        ["perturbation = state is not allowed with role = convergence_quiet: it must be none"],
    ),
    (
        study(TALL, role="pairs"),
        ["second_body = rigid is not allowed with role = pairs: it must be deformable"],
    ),
    (
        {
            "studies": {
                name: {"role": "map", "runs_per_job": 2, "measure": "stability", "runs": [TALL]}
                for name in ("one", "other")
            }
        },
        ["studies.other.role = map is not allowed: studies.one has it"],
    ),
    # a second body
    (study({"height": 0.1, "second_density": 2000.0}), [f"{RUN}: second_density = 2000.0 {RIGID}"]),
    (
        study(TALL | {"second_height": 0.1}, defaults={"second_body": "rigid"}),
        [f"{RUN}: second_height = 0.1 {RIGID}"],
    ),
]


@pytest.mark.parametrize(("config", "fragments"), BAD, ids=[" ".join(x) for _, x in BAD])
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


YAML = {
    "key twice": (b"a: 1\nb: 2\na: 3\n", "the key a is given twice, in lines 1 and 3"),
    "code": (b"x: !!python/object/apply:os.getcwd []\n", "is not valid YAML"),
    "a list as a key": (b"? [a, b]\n: 1\n", "is not valid YAML"),
    "octal": (b"n_x: 0400\n", "line 1: YAML reads 0400 as 256"),
    "sexagesimal": (b"a: 1\nend_time: 1:30\n", "line 2: YAML reads 1:30 as 90"),
    "no such date": (b"a: 2001-99-99\n", "is not valid YAML"),
    "integer without end": (b"a: " + b"9" * 5000, "is not valid YAML"),
    "endless nesting": (b"[" * 100_000, "is not valid YAML"),
}


@pytest.mark.parametrize(("content", "fragment"), YAML.values(), ids=YAML.keys())
def test_bad_file_is_named(tmp_path, content, fragment):
    path = tmp_path / "config.yaml"
    path.write_bytes(content)
    with pytest.raises(ParameterError, match=r"config\.yaml") as caught:
        read_yaml(path)
    assert fragment in str(caught.value)


def test_missing_file_is_named(tmp_path):
    for path, reason in ((tmp_path, "Is a directory"), (tmp_path / "none.yaml", "No such file")):
        with pytest.raises(ParameterError, match=f"can't be read: {reason}") as caught:
            read_yaml(path)
        assert str(path) in str(caught.value)


def test_ordinary_numbers_are_read(tmp_path):
    path = tmp_path / "config.yaml"
    path.write_text("[0, 10, -7, 1_000, 0x10, 0.05, 1.0e-8, .5, 00.5]")
    assert read_yaml(path) == [0, 10, -7, 1000, 16, 0.05, 1e-8, 0.5, 0.5]


def test_results_need_a_directory(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "file").write_text("kept")
    (tmp_path / "nowhere").symlink_to("missing")
    assert directory_problem("new/below") is None
    assert directory_problem(str(tmp_path)) is None
    for name in ("file", "file/below", "nowhere", "nowhere/below"):
        text = directory_problem(name)
        assert f"results = '{name}' is not allowed" in text
        assert "is no directory" in text
    assert (tmp_path / "file").read_text() == "kept"


def test_results_need_a_writable_directory(tmp_path, monkeypatch):
    """The privileged may write anywhere: whether one may is what the system says."""
    monkeypatch.setattr(os, "access", lambda path, mode: not mode & os.W_OK)
    assert "is not writable" in directory_problem(tmp_path / "new")


@pytest.mark.parametrize(
    ("given", "meant"),
    [("a/../b", "b"), ("./b//c/", "b/c"), ("/tmp/a/../b", "/tmp/b"), ("../b", "../b"), ("b", "b")],
)
def test_results_have_their_shortest_name(given, meant):
    assert configure(study(TALL) | {"results": given}).results == meant
