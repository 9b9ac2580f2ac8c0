"""Warnings about allowed values that will hardly give what is wanted."""

import math

import numpy as np
import pytest
import square_evolution
from configurations import messages, papers, study

from nucleation.fem.grid import Grid
from nucleation.model.friction import Friction
from nucleation.run.run import PAPER_RUN
from nucleation.run.sizing import element_height, steepness
from replication.configuration.advice import summary_of_meshes, warned
from replication.configuration.load import configure

GOOD = {"height": 0.005, "n_x": 400}


def advise(runs):
    return [text for text, _ in warned(runs)]


def advice(*runs, **settings):
    return advise(configure(study(*runs, **settings)).runs)


def test_the_papers_configuration_needs_no_warning():
    """The twenty other faults have meshes that are coarse on purpose: their runs take an hour."""
    assert advise([run for run in papers().runs if run.study != "other_faults"]) == []


def test_process_zone_of_the_paper():
    """By hand, from the constants f, a, zeta of science: b = 0.00682 + 0.0156, nu = 1/3."""
    thick = 3.1e9 * 5e-7 / (2.0 / 3.0 * (0.00682 + 0.0156) * 1e6)
    tall = PAPER_RUN.replaced(height=10.0)
    assert tall.process_zone() == pytest.approx(thick, rel=2e-3)
    thin = PAPER_RUN.replaced(height=0.005)
    assert thin.process_zone() == pytest.approx(math.sqrt(2 * 0.005 * thick), rel=2e-3)


def weakening(growth, omega):
    """Mean fall of friction with slip over b/D, along a slip that takes Omega down to 1."""
    omegas = np.geomspace(omega, 1.0 + 1e-9, 200_001)
    steps = np.diff(omegas) / growth(0.5 * (omegas[1:] + omegas[:-1]))
    slip = np.concatenate([[0.0], np.cumsum(steps)])
    fall = np.log(omegas)
    energy = np.sum(0.5 * (fall[1:] + fall[:-1]) * np.diff(slip))
    return fall[0] ** 2 / (2.0 * energy)


@pytest.mark.parametrize("omega", [1.5, 20.0, 1e3, 1e8])
def test_steepness_is_the_mean_weakening_along_the_slip(omega, square):
    expected = max(weakening(square_evolution.growth, omega), 1.0)
    assert steepness(Friction(law="product"), omega) == pytest.approx(expected, rel=1e-3)


@pytest.mark.filterwarnings("error")
def test_round_off_of_steady_sliding_is_no_age():
    for evolution in ("aging", "slip"):
        assert steepness(Friction(law="product", evolution=evolution), 1.0000000000000002) == 1.0


@pytest.mark.parametrize(
    ("varies", "change", "warned"),
    [("zeta", -0.5, True), ("zeta", -2.0, False), ("a", -0.4, True), ("a", -0.6, False)],
)
def test_a_patch_may_weaken_in_a_fault_that_strengthens(varies, change, warned):
    defaults = {
        "block_length": 12.0,
        "n_x": 201,
        "n_y": 16,
        "grading": 64.0,
        "loading": "remote",
        "stress_rate": 1e-3,
        "second_body": "deformable",
        "friction_law": "dieterich_ruina",
        "friction": 0.4,
        "a": 0.0068,
        "zeta": -0.0034,
        "end_time": 10.0,
        "heterogeneity": varies,
        "shape": "step",
        "width": 1.2,
        "change": change,
    }
    given = advice({"height": 1.0}, defaults=defaults)
    assert any("nothing will nucleate" in text for text in given) == warned


@pytest.mark.parametrize("omega", [0.1, 1.0, 1.5, 20.0, 1e8])
def test_steepness_of_the_laws_of_the_house(omega):
    """Aging weakens at b/D over any drop; the slip law's energy is b D times the drop."""
    assert steepness(Friction(law="product", evolution="aging"), omega) == 1.0
    slip = steepness(Friction(law="product", evolution="slip"), omega)
    assert slip == pytest.approx(max(0.5 * math.log(omega), 1.0), rel=1e-12)


def test_growth_time_by_force_balance():
    """The edge's displacement that lets a thin bar slip over a length against f sigma0."""
    parameters = PAPER_RUN.replaced(height=1e-6)
    modulus = 2.0 * 3.1e9 / (1.0 - 1.0 / 3.0)
    displacement = 0.4143 * 1e6 * 0.2**2 / (2.0 * modulus * 1e-6)
    assert parameters.growth_time(0.2) == pytest.approx(displacement / 1e-5, rel=1e-3)


@pytest.mark.parametrize(("n_y", "grading"), [(10, 1.0), (2, 5.0), (20, 20.0)])
def test_element_heights_are_the_grids(n_y, grading):
    grid = Grid(2.0, 0.02, 60, n_y, grading)
    assert element_height(0.02, n_y, grading) == pytest.approx(grid.y[1] - grid.y[0], rel=1e-9)


WARNED = {
    "mesh too coarse along x": (
        GOOD | {"n_x": 100},
        "elements of 0.0141 m, 2.3 to a process zone of 0.0322 m; recommended is n_x = 132 or more",
    ),
    "mesh too coarse along y": (
        {"height": 1.0, "n_x": 400, "n_y": 10},
        "elements of 0.1 m at the interface, 1 to a process zone of 0.104 m; recommended are",
    ),
    "time steps too long": (GOOD | {"longest_step": 0.8}, ""),
    "simulated time too short": (
        GOOD | {"end_time": 5.0},
        "end_time = 5 s, but the patch needs about 9.25 s to become unstable, at L_s = 0.134 m",
    ),
    "simulated time may end before the drop": (
        GOOD | {"zeta_over_a": 0.4, "end_time": 150.0},
        "s until the force drops, at L = ",
    ),
    "block short": (
        GOOD | {"block_length": 0.25},
        "block_length = 0.25 m, but the patch becomes up to 0.188 m long until the force drops; "
        "recommended is 0.313 m or more",
    ),
    "tolerance too large": (GOOD | {"tolerance": 0.5}, "tolerance = 0.5 is the error of log"),
    "perturbation lost in the mesh's noise": (
        GOOD | {"perturbation": "normal_load", "strength": 1e-4},
        "strength = 0.0001 with 9.1 elements to a process zone",
    ),
    "roughness not resolved": (
        GOOD | {"perturbation": "state", "strength": 1e-3, "correlation_length": 0.01},
        "correlation_length = 0.01 m has 2.8 elements of 0.00352 m, which represent another "
        "roughness; recommended is n_x = 564 or more",
    ),
}


@pytest.mark.parametrize("kind", WARNED)
def test_warning_names_study_run_and_numbers(kind):
    run, text = WARNED[kind]
    (warning,) = advice(run, interface="main_text")
    name = configure(study(run, interface="main_text")).runs[0].id
    assert warning.startswith(f"studies.s: {kind} ({name})")
    assert text in warning


REMOTE = {
    "height": 1.0,
    "n_x": 401,
    "n_y": 16,
    "grading": 64.0,
    "loading": "remote",
    "stress_rate": 1e4,
    "second_body": "deformable",
    "end_time": 60.0,
    "block_length": 2.0,
}


@pytest.mark.parametrize(
    ("changed", "text"),
    [
        ({"end_time": 30.0}, "simulated time too short (s-"),
        ({"end_time": 30.0}, "end_time = 30 s, but the shear stress needs about 4"),
        ({"block_length": 0.4}, "block_length = 0.4 m is the period along x"),
    ],
)
def test_a_remote_load_is_warned_of_an_early_end_and_a_short_period(changed, text):
    """Nothing was said: the strength is reached after 44 s, and L_c is .8 m."""
    assert advice(REMOTE) == []
    (warning,) = advice(REMOTE | changed)
    assert text in warning


NOISE = ("perturbation lost in the mesh's noise", "roughness not resolved")


@pytest.mark.parametrize("noisy", NOISE)
def test_refinement_is_not_warned_of_the_noise_that_it_shows(noisy):
    run, _ = WARNED[noisy]
    named = {"mine": {"role": "convergence", "interface": "main_text", "runs": [run]}}
    assert advise(configure({"studies": named}).runs) == []


def test_the_mesh_has_to_resolve_the_front_of_a_law_of_ones_own(square):
    """On 60 elements L_c was .11 of the theory's, on 120 it is 12 % off; aging needs 88."""
    run = {"height": 0.02, "n_x": 120, "n_y": 6, "grading": 4.0}
    (warning,) = advice(run, length_over_critical=4.0)
    assert "mesh too coarse along x" in warning
    need = int(warning.split("recommended is n_x = ")[1].split()[0])
    assert 200 < need < 480, "between meshes that are 12 and 2 % off"
    assert advice(run | {"n_x": need}, length_over_critical=4.0) == []
    assert advice(run | {"n_x": need - 1}, length_over_critical=4.0) != []


def test_a_warning_names_every_run_the_worst_first():
    (text,) = advice({"height": [0.005, 0.006], "n_x": [60, 80]}, length_over_critical=6.0)
    ids = [f"s-aging-H{height}-phi1-n_x{n_x}" for n_x in (60, 80) for height in (0.005, 0.006)]
    assert all(identifier in text for identifier in ids)
    assert "(4 runs, the worst s-aging-H0.00" in text and "n_x60" in text.partition(")")[0]


def test_the_summary_counts_runs_and_has_the_worst_mesh():
    runs = configure(study({"height": 0.005, "n_x": [60, 80]}, {"height": 1.0, "n_y": 10})).runs
    coarse = [run for _, concerned in warned(runs) for run in concerned]
    assert {run.id for run in coarse} == {run.id for run in runs}
    text = summary_of_meshes(coarse, "list.txt")
    worst = min(runs, key=lambda run: run.run.block.n_x)
    along = worst.run.block.length / worst.run.block.n_x
    zone = worst.run.process_zone(worst.run.growth_time(worst.critical_length))
    assert f"3 runs have a coarse mesh, with {zone / along:.2g} elements" in text
    assert worst.id in text and text.endswith("list.txt lists them")
    ((_, coarse),) = warned(configure(study(GOOD | {"block_length": 0.25})).runs)
    assert coarse == []


def test_a_control_run_needs_its_length_and_is_said_to_stay_quiet():
    """It was refused, length or not; and where it ran, a critical length stood beside."""
    strengthening = GOOD | {"zeta_over_a": -0.5}
    assert "needs its block_length (m)" in messages(study(strengthening))
    settings = configure(study(strengthening | {"block_length": 1.4}))
    assert math.isnan(settings.runs[0].critical_length)
    (warning,) = advise(settings.runs)
    assert "nothing will nucleate" in warning and "stable at every wavelength" in warning
    assert "critical length" not in warning
