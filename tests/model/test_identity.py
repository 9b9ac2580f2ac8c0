"""Which runs are of the same fault: all that physics depends on, and nothing else."""

import pytest

from nucleation.run.derived import ensemble, fault
from nucleation.run.run import PAPER_RUN

PAIR = PAPER_RUN.replaced(second_body="deformable", height=0.02)
PHYSICS = [
    {"shear_modulus": 9e9},
    {"poisson_ratio": 0.2},
    {"density": 2000.0},
    {"height": 0.01},
    {"initial_state": 2.0},
    {"velocity": 2e-5},
    {"normal_stress": 2e6},
    {"slip_distance": 1e-6},
    {"initial_stress": "uniform_shear"},
    {"evolution": "slip"},
    {"second_body": "deformable"},
    {"friction_law": "dieterich_ruina"},
]
OF_SECOND = [
    {"second_shear_modulus": 9e9},
    {"second_poisson_ratio": 0.2},
    {"second_density": 2000.0},
    {"second_height": 0.01},
    {"second_far_side": "clamped"},
    {"shear_modulus": 9e9},
]
CASES = [*((PAPER_RUN, values) for values in PHYSICS), *((PAIR, values) for values in OF_SECOND)]


@pytest.mark.parametrize(("run", "values"), CASES, ids=lambda x: str(x)[:40])
def test_another_physics_is_another_fault(run, values):
    assert fault(run.replaced(**values)) != fault(run)


def test_mesh_steps_record_and_perturbation_are_not_of_the_fault():
    other = PAIR.replaced(
        n_x=90,
        n_y=5,
        grading=7.0,
        block_length=3.0,
        tolerance=1e-3,
        end_time=3.0,
        strength=1e-3,
        longest_step=0.02,
        perturbation="state",
        seed=4,
        correlation_length=0.1,
        second_n_y=9,
        second_grading=2.0,
        record="lengths",
    )
    assert fault(other) == fault(PAIR) and ensemble(other) != ensemble(PAIR)


def test_numbers_that_differ_by_rounding_are_the_same():
    assert 0.1 * 3 != 0.3
    assert fault(PAPER_RUN.replaced(height=0.1 * 3)) == fault(PAPER_RUN.replaced(height=0.3))
    assert fault(PAPER_RUN.replaced(height=0.3 + 1e-8)) != fault(PAPER_RUN.replaced(height=0.3))


def test_realisations_differ_in_the_seed_alone():
    declared = PAPER_RUN.replaced(perturbation="state", strength=1e-3, seed=1)
    assert ensemble(declared) == ensemble(declared.replaced(seed=2))
    for values in ({"correlation_time": 2.0}, {"n_x": 90}, {"shortest_step": 1e-9}):
        assert ensemble(declared) != ensemble(declared.replaced(**values))
