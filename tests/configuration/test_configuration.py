"""The configuration: what is made of a good one, and what is said about a bad one."""

import math

import pytest
import yaml
from configurations import CONFIG, PAPER, changed, messages, with_run

from nucleation.configuration.grids import expand
from nucleation.configuration.load import configure, load, schema
from nucleation.configuration.runs import first_realisations
from nucleation.model.friction.law import Friction
from nucleation.model.linearised import InterfaceState
from nucleation.model.material import Material
from nucleation.model.parameters import Loading, Parameters
from nucleation.model.quantities import ParameterError, declarations
from nucleation.theory.critical import critical_length

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
    "number as text": (
        changed("friction.regularisation_slip_rate", "1e-9"),
        ["regularisation_slip_rate = '1e-9' m/s", "write 1.0e-9"],
    ),
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
    "text for text list": (with_run(height=0.01, law=["slip", 3]), [f"{RUN}.law[1] = 3"]),
    "the whole is a list": ([1, 2], ["the configuration = [1, 2] must be a mapping"]),
    "the whole is empty": (None, ["the configuration = None must be a mapping"]),
    # unknown words
    "unknown law": (with_run(height=0.01, law="ageing"), [f"{RUN}.law = 'ageing'", "aging, slip"]),
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
    "no height": (with_run(law="slip"), [f"{RUN}: the run has no height"]),
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
    text = messages(config)
    for fragment in fragments:
        assert fragment in text
    assert text.startswith("the configuration has one problem:\n")


def test_all_problems_are_reported_together():
    config = changed("material.poisson_ratio", 0.5)
    config["loading"]["velocity"] = "fast"
    config["studies"]["paper"]["runs"].append({"heigth": 0.1, "law": "none"})
    text = messages(config)
    assert text.startswith("the configuration has 4 problems:")
    for fragment in ("poisson_ratio", "velocity = 'fast'", "heigth", "law = 'none'"):
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


def test_committed_schema_is_the_declarations():
    assert (CONFIG / "schema.yaml").read_text() == schema.text(), "run make schema"


def test_every_key_has_a_description_and_every_value_a_unit():
    def leaves(node, path):
        assert node.get("description"), path
        for name, child in node.get("properties", {}).items():
            if "$ref" not in child:
                yield from leaves(child, f"{path}.{name}")
        if "properties" not in node and node.get("type") not in ("object", "array"):
            yield path, node.get("unit", node.get("anyOf", [{}])[0].get("unit"))

    whole = schema.build()
    found = [*leaves(whole, ""), *leaves(whole["$defs"]["study"], "study")]
    assert len(found) > 50
    for path, unit in found:
        if not path.startswith("study.runs"):
            assert unit, path


def test_every_mapping_is_closed():
    def mappings(node):
        if isinstance(node, dict):
            if "properties" in node and node.get("type") == "object":
                yield node
            for child in node.values():
                yield from mappings(child)

    assert all(node["additionalProperties"] is False for node in mappings(schema.build()))


def test_default_configuration_is_the_papers():
    paper = load(CONFIG / "config.yaml")
    assert paper.results == "results"
    assert paper.base.material == Material()
    assert paper.friction == Friction()
    assert paper.base.loading == Loading()
    assert paper.main_text_interface == InterfaceState()
    assert {key for key in schema.GROUPS if key not in PAPER} == set()
    for group in schema.GROUPS:
        keys = declarations(type(paper.friction)) if group == "friction" else None
        assert set(PAPER[group]) == set(keys or schema.group_entries(group)), group


def test_papers_study():
    runs = load(CONFIG / "config.yaml").runs_of("paper")
    aging = [r for r in runs if r.labels["law"] == "aging" and r.labels["phi0"] == 1.0]
    heights = [0.005, 0.01, 0.02, 0.03, 0.04, 0.05, 0.06, 0.08, 0.1]
    assert [run.labels["height"] for run in aging] == heights
    assert aging[0].id == "paper-aging-H0.005-phi1"
    others = {run.id for run in runs} - {run.id for run in aging}
    assert others == {
        "paper-slip-H0.01-phi1",
        "paper-slip-H0.05-phi1",
        "paper-aging-H0.1-phi1000",
    }
    for run in runs:
        assert (run.parameters.mesh.n_x, run.parameters.mesh.n_y) == (400, 150)
        expected = critical_length(run.labels["height"], Material(), InterfaceState())
        assert run.theory_length == pytest.approx(float(expected), rel=1e-12)
        assert run.parameters.geometry.length == pytest.approx(6.0 * expected, rel=1e-3)


def test_converged_study_has_the_papers_runs():
    config = load(CONFIG / "config.yaml")
    runs = config.runs_of("converged")
    first = first_realisations(runs)
    labels = [[r.labels | {"study": ""} for r in some] for some in (config.runs_of("paper"), first)]
    assert labels[0] == labels[1]
    assert len(runs) == 3 * len(first)
    for run in runs:
        assert run.parameters.perturbation.acts


def test_entries_have_defaults_of_their_own_that_are_in_no_name():
    entry = {"height": [0.02, 0.1], "defaults": {"longest_step": 0.02}}
    values = {"studies": {"mine": {"defaults": {"longest_step": 0.1, "n_x": 90}, "runs": [entry]}}}
    runs = configure(values).runs
    assert [run.id for run in runs] == ["mine-aging-H0.02-phi1", "mine-aging-H0.1-phi1"]
    for run in runs:
        assert (run.parameters.stepping.longest_step, run.parameters.mesh.n_x) == (0.02, 90)
    entry["longest_step"] = [0.05, 0.1]  # what the entry itself gives is stronger
    assert {r.parameters.stepping.longest_step for r in configure(values).runs} == {0.05, 0.1}
    entry["defaults"] = {"longest_step": -1.0}
    with pytest.raises(ParameterError, match=r"studies.mine.runs\[0\].defaults.longest_step = -1"):
        configure(values)


def test_quick_configuration_has_what_the_figures_show():
    quick = load(CONFIG / "quick.yaml")
    assert quick.results != "results"
    for height in (quick.figures.inset_height, quick.figures.space_time_height):
        assert quick.find(study="paper", law="aging", height=height, phi0=1.0)
    laws = {(run.labels["law"], run.labels["phi0"]) for run in quick.runs}
    assert laws == {("aging", 1.0), ("slip", 1.0), ("aging", 1000.0)}


def test_missing_keys_have_the_declared_defaults():
    config = configure({"studies": {"one": {"runs": [{"height": 0.01}]}}})
    (run,) = config.runs
    assert run.parameters.material == Material()
    assert run.parameters.mesh == Parameters().mesh
    assert config.results == "results"


def test_grid_and_identifiers():
    config = configure(
        {
            "studies": {
                "grid": {
                    "defaults": {"n_y": 20, "poisson_ratio": 0.25},
                    "runs": [
                        {
                            "height": {"start": 0.01, "stop": 1.0, "num": 3, "scale": "log"},
                            "n_x": [100, 200],
                            "shear_modulus": 4.0e9,
                            "phi0": 1000000.0,
                        }
                    ],
                }
            }
        }
    )
    ids = [run.id for run in config.runs]
    assert len(ids) == 6
    assert ids[0] == "grid-aging-H0.01-phi1000000-shear_modulus4000000000-n_x100"
    assert {run.labels["height"] for run in config.runs} == {0.01, 0.1, 1.0}
    for run in config.runs:
        assert run.parameters.material == Material(4.0e9, 0.25)
        assert run.parameters.mesh.n_y == 20
        assert all(character.isalnum() or character in "-_." for character in run.id)


def test_identifier_does_not_depend_on_other_entries():
    alone = configure({"studies": {"s": {"runs": [{"height": 0.01, "n_x": 100}]}}})
    entries = [{"height": 0.01, "n_x": 100}, {"height": 0.01, "density": [1000, 1200]}]
    together = configure({"studies": {"s": {"runs": entries}}})
    assert alone.runs[0] == together.runs[0]


def identifiers(*runs):
    return [run.id for run in configure({"studies": {"s": {"runs": list(runs)}}}).runs]


def test_identifiers_stay_when_studies_are_edited():
    """Values added or reordered, keys reordered, runs added before: the others keep their names."""
    first = identifiers({"height": [0.01, 0.02], "tolerance": 0.001, "n_x": [100, 200]})
    edits = [
        [{"n_x": [200, 400, 100], "height": [0.03, 0.02, 0.01], "tolerance": 0.001}],
        [{"height": 0.05}, {"tolerance": 0.001, "n_x": [100, 200], "height": [0.01, 0.02]}],
    ]
    for runs in edits:
        assert set(first) < set(identifiers(*runs))


def test_identifiers_do_not_depend_on_notation(tmp_path):
    forms = [
        "{height: 0.005, n_x: 100, density: 1200, characteristic_slip_distance: 5.0e-7}",
        "{height: 5.0e-3, n_x: 1_00, density: 1.2e+3, characteristic_slip_distance: 0.0000005}",
        "{height: 0.0050, n_x: +100, density: 1200.0, characteristic_slip_distance: 5.00E-7}",
    ]
    found = []
    for form in forms:
        path = tmp_path / "config.yaml"
        path.write_text(f"studies: {{s: {{runs: [{form}]}}}}")
        found.append(load(path).runs)
    assert repr(found[0]) == repr(found[1]) == repr(found[2])
    assert found[0][0].id == (
        "s-aging-H0.005-phi1-density1200-characteristic_slip_distance5e-7-n_x100"
    )


def test_constants_of_the_law_in_a_study():
    ratios = [0.5, 2.0]
    config = configure({"studies": {"s": {"runs": [{"height": 0.01, "zeta_over_a": ratios}]}}})
    usual = Friction().expansion(1e-5)
    for run, ratio in zip(config.runs, ratios, strict=True):
        assert run.id == f"s-aging-H0.01-phi1-zeta_over_a{ratio:g}"
        f, a, zeta = run.parameters.friction.expansion(1e-5)
        assert (f, a, zeta / a) == pytest.approx((usual.f0, usual.a, ratio), rel=1e-10)
        expected = critical_length(0.01, Material(), InterfaceState(f, a, zeta))
        assert run.theory_length == pytest.approx(float(expected), rel=1e-10)
        assert run.value("zeta_over_a") == ratio
        assert run.value("direct_effect") == pytest.approx(usual.a)
        assert run.value("phi0") == 1.0


def test_theory_of_each_runs_own_friction():
    study = {"runs": [{"height": 0.01}], "interface": "friction_law"}
    own = configure({"studies": {"s": study}}).runs[0]
    expansion = Friction().expansion(1e-5)
    interface = InterfaceState(expansion.f0, expansion.a, expansion.zeta)
    assert own.theory_length == pytest.approx(
        float(critical_length(0.01, Material(), interface)), rel=1e-12
    )


def test_integers_and_reals_give_the_same_run():
    one = configure(changed("studies.paper.runs", [{"height": 1, "phi0": 1}]))
    other = configure(changed("studies.paper.runs", [{"height": 1.0, "phi0": 1.0}]))
    assert repr(one.runs) == repr(other.runs)


def test_ranges():
    assert expand({"start": 0.0, "stop": 0.3, "num": 4}) == (0.0, 0.1, 0.2, 0.3)
    assert expand({"start": 1e-3, "stop": 10, "num": 3, "scale": "log"}) == (0.001, 0.1, 10.0)
    assert expand([3, 1]) == (3, 1)
    assert expand("slip") == ("slip",)


@pytest.mark.slow
def test_parameters_survive_the_way_through_a_rule():
    for run in load(CONFIG / "config.yaml").runs:
        as_text = yaml.safe_dump(run.parameters.to_dict())
        assert Parameters.from_dict(yaml.safe_load(as_text)) == run.parameters


def test_unknown_run_is_named():
    with pytest.raises(ParameterError, match="no run of the configuration has height 7"):
        load(CONFIG / "quick.yaml").find(height=7)
