"""The configuration: what is made of a good one."""

import math
from collections import Counter
from pathlib import Path

import pytest
from configurations import CONFIG, PAPER, papers, study

from nucleation.fault import Fault
from nucleation.model.friction import Friction
from nucleation.model.material import Material
from nucleation.model.quantities import ParameterError, declarations
from nucleation.run.run import PAPER_RUN
from replication.configuration.advice import faults_of
from replication.configuration.load import configure, load
from replication.configuration.runs import first_realisations
from replication.configuration.settings import GROUPS, SECTIONS, entries_of
from replication.configuration.studies import theory_curves

MAIN_TEXT = papers().main_text


def test_default_configuration_is_the_papers():
    paper = papers()
    assert paper.results == "results"
    assert (paper.base.fault, paper.base.law) == (PAPER_RUN.fault, PAPER_RUN.law)
    assert paper.base.start == PAPER_RUN.start
    assert {key for key in (*SECTIONS, *GROUPS) if key not in PAPER} == set()
    law = {"friction_law" if name == "law" else name for name in declarations(type(paper.base.law))}
    for section in (*SECTIONS, *GROUPS):
        keys = law if section == "friction" else set(entries_of(section))
        assert set(PAPER[section]) == keys, section


def test_papers_study():
    runs = papers().runs_of("paper")
    usual = {"evolution": "aging", "initial_state": 1.0}
    aging = [run for run in runs if usual.items() <= run.labels.items()]
    heights = [0.005, 0.01, 0.02, 0.03, 0.04, 0.05, 0.06, 0.08, 0.1]
    assert [run.labels["height"] for run in aging] == heights
    assert aging[0].id == "paper-aging-H0.005-phi1"
    others = {run.id for run in runs} - {run.id for run in aging}
    expected = {"slip-H0.01-phi1", "slip-H0.05-phi1", "aging-H0.1-phi1000"}
    assert others == {f"paper-{name}" for name in expected}
    for run in runs:
        assert (run.run.block.n_x, run.run.block.n_y) == (400, 150)
        expected = MAIN_TEXT.replace(height=run.labels["height"]).critical_length()
        assert run.critical_length == pytest.approx(float(expected), rel=1e-12)
        assert run.run.block.length == pytest.approx(6.0 * expected, rel=1e-3)


def test_converged_study_has_the_papers_runs():
    config = papers()
    runs = config.runs_of("converged")
    first = first_realisations(runs)
    labels = [[r.labels | {"study": ""} for r in some] for some in (config.runs_of("paper"), first)]
    assert labels[0] == labels[1]
    realisations = Counter(run.run.replaced(seed=0, record="lengths") for run in runs)
    assert set(realisations.values()) == {3, 6}
    for run in runs:
        assert run.run.perturbation.acts


def test_entries_have_defaults_of_their_own_that_are_in_no_name():
    entry = {"height": [0.02, 0.1], "defaults": {"longest_step": 0.02}}
    values = {"studies": {"mine": {"defaults": {"longest_step": 0.1, "n_x": 90}, "runs": [entry]}}}
    runs = configure(values).runs
    assert [run.id for run in runs] == ["mine-aging-H0.02-phi1", "mine-aging-H0.1-phi1"]
    for run in runs:
        assert (run.run.stepping.longest_step, run.run.block.n_x) == (0.02, 90)
    entry["longest_step"] = [0.05, 0.1]  # what the entry itself gives is stronger
    assert {r.run.stepping.longest_step for r in configure(values).runs} == {0.05, 0.1}
    entry["defaults"] = {"longest_step": -1.0}
    with pytest.raises(ParameterError, match=r"studies.mine.runs\[0\].defaults.longest_step = -1"):
        configure(values)


def test_grid_and_identifiers():
    heights = {"start": 0.01, "stop": 1.0, "num": 3, "scale": "log"}
    entry = {"height": heights, "n_x": [100, 200], "shear_modulus": 4.0e9, "initial_state": 1e6}
    config = configure(study(entry, defaults={"n_y": 20, "poisson_ratio": 0.25}))
    assert config.results == "results" and len(config.runs) == 6
    assert config.runs[0].id == "s-aging-H0.01-phi1000000-shear_modulus4000000000-n_x100"
    assert {run.labels["height"] for run in config.runs} == {0.01, 0.1, 1.0}
    for run in config.runs:
        assert run.run.upper.material == Material(4.0e9, 0.25, 1200.0)
        assert run.run.block.n_y == 20
        assert all(character.isalnum() or character in "-_." for character in run.id)


def identifiers(*runs):
    return [run.id for run in configure(study(*runs)).runs]


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
        "{height: 0.005, n_x: 100, density: 1200, slip_distance: 5.0e-7}",
        "{height: 5.0e-3, n_x: 100, density: 1.2e+3, slip_distance: 0.0000005}",
        "{height: 0.0050, n_x: +100, density: 1200.0, slip_distance: 5e-7}",
    ]
    found = set()
    for form in forms:
        path = tmp_path / "config.yaml"
        path.write_text(f"studies: {{s: {{runs: [{form}]}}}}")
        (run,) = load(path).runs
        found.add((run.id, repr(run)))
    ((identifier, _),) = found
    assert identifier == "s-aging-H0.005-phi1-density1200-slip_distance5e-7-n_x100"


def test_constants_of_the_law_in_a_study():
    ratios = [0.5, 2.0]
    config = configure({"studies": {"s": {"runs": [{"height": 0.01, "zeta_over_a": ratios}]}}})
    usual = Friction(law="product").expansion(1e-5)
    for run, ratio in zip(config.runs, ratios, strict=True):
        assert run.id == f"s-aging-H0.01-phi1-zeta_over_a{ratio:g}"
        f, a, zeta = run.run.law.expansion(1e-5)
        assert (f, a, zeta / a) == pytest.approx((usual.f0, usual.a, ratio), rel=1e-10)
        own = {"friction": f, "a": a, "zeta": zeta, "height": 0.01}
        expected = MAIN_TEXT.replace(**own).critical_length()
        assert run.critical_length == pytest.approx(float(expected), rel=1e-10)
        assert run.value("zeta_over_a") == ratio
        assert run.value("a") == pytest.approx(usual.a)
        assert run.value("initial_state") == 1.0


def curves(*runs, **settings):
    made = configure(study(*runs, **settings))
    return made.runs, theory_curves(list(made.runs), made)


@pytest.mark.parametrize("interface", ["main_text", "friction_law"])
def test_curve_goes_through_the_runs(interface):
    entry = {"height": [0.01, 0.1], "evolution": ["aging", "slip"], "n_x": 400}
    runs, found = curves(entry, interface=interface)
    assert len(found) == 2
    for i, run in enumerate(runs):
        (curve,) = (curve for curve in found if i in curve["members"])
        at = curve["x"].index(run.labels["height"])
        assert curve["length"][at] == pytest.approx(run.critical_length, rel=1e-7)
        assert curve["between"][0]["evolution"] == run.labels["evolution"]
    assert len(curve["x"]) > 50 and len(curve["between"]) == 9
    assert [one["height"] for one in curve["between"]] == curve["x"][::10]


def test_curves_are_closely_spaced_where_strengths_and_realisations_vary_too():
    entry = {"height": [0.01, 0.1, 1.0], "perturbation": "state", "strength": [1e-4, 1e-3]}
    runs, found = curves({**entry, "seed": [1, 2]})
    assert [{runs[i].value("strength") for i in curve["members"]} for curve in found] == [
        {1e-4},
        {1e-3},
    ]
    assert all(len(curve["x"]) > 50 for curve in found)


def test_figures_show_the_nearest_height():
    quick = load(CONFIG / "quick.yaml")
    highest = max(run.labels["height"] for run in quick.runs_for("paper"))
    assert quick.shown(7.0).labels["height"] == highest
    old = study({"height": 0.1, "initial_state": 3.0}, role="paper")
    with pytest.raises(ParameterError, match="has a run with evolution = aging and initial_state"):
        configure(old).shown(0.1)


def test_figure_3_with_other_heights_is_one_edit():
    """The study keeps its role and mesh, and the theory's curve begins below the lowest point."""
    made = configure({"studies": {"paper": {"runs": [{"height": [0.001, 0.2]}]}}})
    assert made.studies_for("paper") == ["paper"]
    low, high = made.runs
    assert (low.run.block.n_y, low.run.fault.height) == (150, 0.001)
    assert made.shown(0.1) == high
    assert made.shown(0.005) == low
    heights = made.drawn_curves().heights
    assert heights[0] < 0.001 and heights[-1] > 0.2 and list(heights) == sorted(heights)
    assert papers().drawn_curves() == papers().curves  # whose heights suffice


def test_another_b_is_one_edit():
    made = configure({"friction": {"aging_coefficient": 0.085}}, lazy=True)
    rounded = {name: float(f"{getattr(made.base.fault, name):.2g}") for name in ("a", "zeta")}
    assert rounded == {name: getattr(made.main_text, name) for name in rounded}
    assert made.runs_of("paper")[0].theory.zeta == rounded["zeta"] != 0.016


@pytest.mark.parametrize("interface", ["main_text", "friction_law"])
@pytest.mark.parametrize("friction", [{"slip_distance": 1e-6}, {"rate_coefficient": 0.006}])
def test_the_theory_follows_the_friction_law(friction, interface):
    """Also where its rounded values are not given; by the functions of the library."""
    made = configure({"friction": friction, **study({"height": 0.005}, interface=interface)})
    (run,) = made.runs
    law, material = run.run.law, run.run.upper.material
    friction, a, zeta = law.expansion(1e-5)
    if interface == "main_text":
        friction, a, zeta = (float(f"{value:.2g}") for value in (friction, a, zeta))
    own = Fault(
        shear_modulus=material.shear_modulus,
        poisson_ratio=material.poisson_ratio,
        height=0.005,
        second_shear_modulus=math.inf,
        normal_stress=1e6,
        a=a,
        zeta=zeta,
        friction=friction,
        slip_distance=law.slip_distance,
    )
    assert run.critical_length == pytest.approx(own.critical_length(), rel=1e-12)


def test_the_papers_rounding_is_that_of_its_own_law():
    """The main text has f = .41, a = .0068 and zeta = .016."""
    for friction in ({}, {"evolution": "slip"}):
        found = configure({"friction": friction, **study({"height": 0.005})}).main_text
        assert (found.friction, found.a, found.zeta) == (0.41, 0.0068, 0.016)
        assert (found.slip_distance, found.velocity) == (5e-7, 1e-5)


GRANITE = {
    "shear_modulus": "30 GPa",
    "poisson_ratio": 0.25,
    "normal_stress": "6 MPa",
    "slip_distance": "0.5um",
    "friction": 0.6,
    "a": 0.008,
    "b": 0.024,
    "velocity": 1e-5,
}


def started(tmp_path, **study):
    """The only run of a study."""
    own = {"defaults": {"n_x": 60, "n_y": 4}, "runs": [{"height": 0.05}], **study}
    (run,) = configure({"results": str(tmp_path), "studies": {"mine": own}}).runs
    return run


@pytest.mark.parametrize("kind", ["mapping", "file"])
def test_a_study_starts_from_the_fault_that_it_names(tmp_path, kind):
    """What is left out has the meaning that it has in Python and on the command line."""
    fault = GRANITE
    if kind == "file":
        fault = str(tmp_path / "fault.yaml")
        Path(fault).write_text("".join(f"{k}: {v}\n" for k, v in GRANITE.items()))
    run = started(tmp_path, fault=fault)
    expected = Fault(**GRANITE, height=0.05)
    assert run.critical_length == pytest.approx(expected.critical_length(), rel=1e-12)
    assert run.run.law == expected.law() and run.run.fault.second_height == 0.05


def test_values_of_a_study_change_its_fault(tmp_path):
    run = started(tmp_path, fault=GRANITE, runs=[{"height": 0.05, "second_body": "rigid"}])
    expected = Fault(**GRANITE, height=0.05, second_shear_modulus=math.inf)
    assert run.critical_length == pytest.approx(expected.critical_length(), rel=1e-12)


def test_the_papers_fault_is_the_default(tmp_path):
    assert started(tmp_path, fault="paper").run == started(tmp_path).run


@pytest.mark.parametrize(
    ("fault", "problem"),
    [
        ({**GRANITE, "hight": 1.0}, "hight = 1.0 is not allowed: unknown key; did you mean height"),
        ({**GRANITE, "normal_stress": "6 m"}, "normal_stress"),
        ({k: x for k, x in GRANITE.items() if k != "velocity"}, "velocity .m/s. is missing"),
        ("nowhere.yaml", "nowhere.yaml can't be read"),
        (3, "must be paper, a file or a mapping"),
        ({**GRANITE, "zone_thickness": 1.0, "zone_shear_modulus": 1e9}, "no simulation has a zone"),
    ],
)
def test_a_fault_that_is_wrong_is_refused(tmp_path, fault, problem):
    with pytest.raises(ParameterError, match=f"studies.mine.fault: .*{problem}"):
        started(tmp_path, fault=fault)


OWN_FAULT = {
    "material": {"shear_modulus": "30 GPa", "poisson_ratio": 0.25},
    "friction": {"slip_distance": "0.5 um"},
    "loading": {"normal_stress": "6 MPa"},
}


@pytest.mark.parametrize("place", ["study", "sections"])
def test_a_whole_fault_among_the_values_needs_its_second_body_and_law(tmp_path, place):
    """The rigid base and the law were the paper's, in silence."""
    own = {"study": GRANITE, "sections": {}}[place]
    sections = {"study": {}, "sections": OWN_FAULT}[place]
    study = {"defaults": {**own, "n_x": 60, "n_y": 4}, "runs": [{"height": 0.05}]}
    values = {"results": str(tmp_path), "studies": {"mine": study}, **sections}
    with pytest.raises(ParameterError, match="but not second_body and friction_law: write"):
        configure(values)


@pytest.mark.parametrize(
    "named",
    [
        {"friction_law": "product", "second_body": "rigid"},
        {"friction_law": "product", "second_body": "deformable"},
    ],
)
def test_a_fault_of_sections_that_names_both_is_taken(tmp_path, named):
    study = {"defaults": {"n_x": 60, "n_y": 4, **named}, "runs": [{"height": 0.05}]}
    values = {"results": str(tmp_path), "studies": {"mine": study}, **OWN_FAULT}
    (run,) = configure(values).runs
    assert math.isinf(run.run.fault.second_shear_modulus) == (named["second_body"] == "rigid")


def test_each_setting_of_a_study_is_named_once(tmp_path):
    bodies = [{"height": [0.05, 0.06]}, {"height": 0.05, "second_body": "rigid"}]
    study = {"fault": GRANITE, "defaults": {"n_x": 60, "n_y": 4}, "runs": bodies}
    runs = configure({"results": str(tmp_path), "studies": {"mine": study}}).runs
    law = "Friction law: dieterich_ruina; evolution: aging."
    bodies = ["Second body: deformable, like the first.", "Second body: rigid."]
    assert faults_of(runs) == [f"{body} {law}" for body in bodies]
