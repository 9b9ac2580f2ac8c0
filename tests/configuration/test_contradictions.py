"""Bad input that has the right types: contradictions, sizes, names, places, and odd YAML."""

import os

import pytest
from configurations import assert_one_problem, changed, study

from nucleation.configuration.contradictions import directory_problem
from nucleation.configuration.load import configure
from nucleation.configuration.strict_yaml import read_yaml
from nucleation.model.quantities import ParameterError

RUN = "studies.s.runs[0]"
TALL = {"height": 0.1}

BAD = {
    # beyond what a number can be, or a list
    "integer beyond any float": (
        changed("material.density", 10**400), ["density = 1000", "[0, 1e+06) kg/m^3"],
    ),
    "integer beyond any mesh": (study({**TALL, "n_x": 10**400}), ["integer in [8, 100000]"]),
    "list in a list": (
        study({**TALL, "velocity": [[1e-5]]}), [f"{RUN}.velocity[0] = [1e-05] m/s", "(0, 1) m/s"],
    ),
    "range of integers": (
        study({**TALL, "n_x": {"start": 100, "stop": 200, "num": 3}}), [f"{RUN}.n_x", "integer"],
    ),
    "range that stands still": (
        changed("curves.heights", {"start": 0.1, "stop": 0.1 + 1e-9, "num": 50}),
        ["curves.heights: its 50 values from 0.1 on are not all different"],
    ),
    "numbers equal in identifiers": (
        study({"height": [0.3, 0.1 + 0.2]}), ["gives the simulation s-aging-H0.3-phi1 again"],
    ),
    "defaults are nothing": (study(TALL, defaults=None), ["studies.s.defaults = None must be"]),
    "a run is nothing": (study(None), [f"{RUN} = None must be a mapping"]),
    "a study is nothing": ({"studies": {"s": None}}, ["studies.s = None must be a mapping"]),
    "a strength of nothing": (
        study({**TALL, "strength": 1e-3}), [f"{RUN}: strength = 0.001 is", "perturbation one of"],
    ),
    "roughness finer than elements": (
        study({**TALL, "perturbation": "strength", "strength": 1e-3, "correlation_length": 1e-4}),
        [f"{RUN}: correlation_length = 0.0001 m is not allowed", "at least an element"],
    ),
    "noise faster than the shortest step": (
        study({**TALL, "perturbation": "state", "strength": 1e-3, "correlation_time": 1e-12}),
        [f"{RUN}: shortest_step = 1e-12 s is not allowed", "longest one, 1e-13 D/V = 5e-15 s"],
    ),
    # names and places
    "truth as a name": ({"studies": {True: {"runs": [TALL]}}}, ["studies: True", "as a name"]),
    "endless name": ({"studies": {"s" * 61: {"runs": [TALL]}}}, ["at most 60", "as a name"]),
    "endless identifier": (
        study(
            TALL | {"characteristic_slip_distance": 5e-7, "regularisation_slip_rate": 1e-9,
                    "initial_stress": "uniform_shear", "initial_shear_stress": 1.0,
                    "rate_coefficient": 0.005, "aging_coefficient": 0.075, "slip_rate_scale": 1e-7,
                    "time_after_event": 0.0}
        ),
        [f"{RUN}: s-aging-H0.1", "characters, more than 200"],
    ),
    "braces": (changed("results", "out/{x}"), ["results = 'out/{x}'", "without braces"]),
    "code by a detour": (changed("results", "results/../src"), ["results = 'src'", "what makes"]),
    "the directory itself": (changed("results", "a/.."), ["results = '.'", "of its own"]),
    "root": (changed("results", "/"), ["results = '/'", "of its own"]),
    "star": (changed("results", "out*"), ["results = 'out*'", "wildcards"]),
    "line break": (changed("results", "a\nb"), ["results = 'a\\nb'", "control characters"]),
    "blank": (changed("results", " "), ["results = ' '", "spaces at its ends"]),
    "of git": (changed("results", ".git/hooks"), ["results = '.git/hooks'", "hidden directories"]),
    "of code": (changed("results", "src/nucleation"), ["results = 'src/nucleation'"]),
    "home": (changed("results", "~/out"), ["results = '~/out'", "write the home directory out"]),
    # contradictions
    "low edge above the edge": (
        changed("extraction.edge_threshold_low", 0.1),
        ["edge_threshold_low = 0.1, edge_threshold = 0.01", "must ascend, each in (0, 1]"],
    ),
    "shortest step above the longest": (
        study(TALL, defaults={"shortest_step": 0.5}),
        [f"{RUN}: shortest_step = 0.5 s", "than the first step, 1e-07 s", "D/V = 0.005 s"],
    ),
    "stress without the start that has it": (
        study({**TALL, "initial_shear_stress": 5e4}),
        [f"{RUN}: initial_shear_stress = 50000 Pa", "no_slip", "must be 0 Pa"],
    ),
    "block shorter than its nucleation length": (
        study({**TALL, "length": 0.5}),
        [f"{RUN}: length = 0.5 m", "critical nucleation length of the theory, 0.81 m"],
    ),
    "block longer than any": (
        study({**TALL, "shear_modulus": 9e12, "characteristic_slip_distance": 900.0}),
        [f"{RUN}: geometry.length = ", "(0, 1e+07) m"],
    ),
    "a theory without instability": (
        {"main_text_interface": {"zeta": -0.005}, **study(TALL)},
        ["main_text_interface: zeta = -0.005 with a = 0.0068", "stable at every wavenumber"],
    ),
    "crosscheck beyond the memory": (
        changed("crosscheck.n_x", 100000),
        ["crosscheck: n_x = 100000, n_y = 8", "MB, more than limits.memory = 2000 MB"],
    ),
    "constants without a law": (
        study({**TALL, "zeta_over_a": 900.0}), [f"{RUN}: no friction law has f = 0.41", "[0, 1)"],
    ),
}  # fmt: skip


@pytest.mark.parametrize(("config", "fragments"), BAD.values(), ids=BAD.keys())
def test_bad_configuration_is_named(config, fragments):
    assert_one_problem(config, fragments)


YAML = {
    "key twice": (b"a: 1\nb: 2\na: 3\n", "the key a stands twice, in lines 1 and 3"),
    "key twice in a mapping": (b"m: {density: 1, density: 2}\n", "key density stands twice"),
    "code": (b"x: !!python/object/apply:os.getcwd []\n", "is not valid YAML"),
    "a list as a key": (b"? [a, b]\n: 1\n", "line 1: a key must be a word"),
    "octal": (b"n_x: 0400\n", "line 1: YAML takes 0400 for 256"),
    "sexagesimal": (b"a: 1\nend_time: 1:30\n", "line 2: YAML takes 1:30 for 90"),
    "no such date": (b"a: 2001-99-99\n", "is not valid YAML"),
    "integer without end": (b"a: " + b"9" * 5000, "is not valid YAML"),
    "binary": (b"\x00\x01\xff\xfe", "is not valid YAML"),
    "latin 1": (b"a: caf\xe9\n", "is not valid YAML"),
    "endless nesting": (b"[" * 5000, "is not valid YAML"),
}


@pytest.mark.parametrize(("content", "fragment"), YAML.values(), ids=YAML.keys())
def test_bad_file_is_named(tmp_path, content, fragment):
    path = tmp_path / "config.yaml"
    path.write_bytes(content)
    with pytest.raises(ParameterError, match=r"config\.yaml") as caught:
        read_yaml(path)
    assert fragment in str(caught.value)


def test_directory_in_place_of_a_file_is_named(tmp_path):
    with pytest.raises(ParameterError, match="can't be read: Is a directory"):
        read_yaml(tmp_path)


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


BOMBS = {
    "aliases": "\n".join(f"{new}: &{new} [{', '.join([f'*{old}'] * 9)}]" for old, new in
                         zip("abcdefgh", "bcdefghi", strict=True)),
    "within itself": "b: &b [*b]",
    "mapping within itself": "b: &b {c: *b}",
}  # fmt: skip


@pytest.mark.parametrize("text", BOMBS.values(), ids=BOMBS.keys())
def test_aliases_can_not_stand_for_millions(tmp_path, text):
    """Ten short lines would take minutes and gigabytes, as messages quote their values."""
    path = tmp_path / "config.yaml"
    path.write_text(f"a: &a [x]\n{text}\n")
    with pytest.raises(ParameterError, match=r"line 1: with its aliases written out"):
        read_yaml(path)


@pytest.mark.parametrize(
    ("given", "meant"),
    [("a/../b", "b"), ("./b//c/", "b/c"), ("/tmp/a/../b", "/tmp/b"), ("../b", "../b"), ("b", "b")],
)
def test_results_have_their_shortest_name(given, meant):
    assert configure(study(TALL) | {"results": given}).results == meant
