"""Plane stress: nu/(1 + nu) for nu at the same mu, in theory, commands and simulations."""

import numpy as np
import pytest
from asked import critical_length, lengths_in_use, spectrum, stability_length, transfer_functions

from benchmarks.assembled import assemble
from nucleation.api import Material, ParameterError
from nucleation.fem.grid import Grid
from nucleation.run.derived import fault
from nucleation.run.run import PAPER_RUN
from nucleation.simulation.run import simulate

PMMA = {
    "shear_modulus": 3.1e9,
    "normal_stress": 1e6,
    "a": 0.0068,
    "zeta": 0.016,
    "slip_distance": 5e-7,
    "friction": 0.41,
    "velocity": 1e-5,
}
NU, NU2 = 0.35, 0.25
SETTINGS = {
    "half-spaces": {},
    "rigid base": {"second_shear_modulus": np.inf, "height": 0.1},
    "two materials": {"second_shear_modulus": 30e9, "height": 0.1, "second_far_side": "clamped"},
}


def both(function, **fault):
    """In plane stress, and in plane strain with the ratios replaced by hand."""
    ratios = {"poisson_ratio": NU, "second_poisson_ratio": NU2}
    changed = {name: nu / (1.0 + nu) for name, nu in ratios.items()}
    return function(**ratios, plane="stress", **fault), function(**changed, **fault)


@pytest.mark.parametrize("setting", SETTINGS.values(), ids=SETTINGS)
@pytest.mark.parametrize(
    "function", [critical_length, stability_length, lengths_in_use, transfer_functions, spectrum]
)
def test_theory_is_that_of_the_other_ratio(function, setting):
    def found(**fault):
        if function in (spectrum, transfer_functions):
            return np.asarray(function([3.0, 30.0], **fault))
        made = function(**fault)
        return np.array(list(made.values())) if function is lengths_in_use else made

    ours, expected = both(found, **PMMA, **setting)
    np.testing.assert_array_equal(ours, expected)


def test_stiffness_matrix_is_that_of_plane_stress():
    """Energies of uniform strains against ``E/(1 - nu^2) [[1, nu], [nu, 1]]``, and wave speeds."""
    material = Material(shear_modulus=1.3e9, poisson_ratio=NU, density=1100.0, plane="stress")
    plate = 2.0 * 1.3e9 * (1.0 + NU) / (1.0 - NU**2)
    grid = Grid(0.3, 0.2, 4, 3)
    stiffness, _ = assemble(grid, material)
    x, y = (positions.ravel() for positions in np.meshgrid(grid.x, grid.y))
    for strain_x, strain_y in ((1.0, 0.0), (0.0, 1.0), (1.0, 1.0)):
        moved = np.column_stack([strain_x * x, strain_y * y]).ravel()
        energy = plate * (strain_x**2 + strain_y**2 + 2.0 * NU * strain_x * strain_y) * 0.3 * 0.2
        assert moved @ stiffness @ moved == pytest.approx(energy, rel=1e-12)
    assert material.p_wave_modulus == pytest.approx(plate, rel=1e-14)
    assert material.shear_wave_speed == Material(1.3e9, 0.3, density=1100.0).shear_wave_speed


def test_simulation_is_that_of_the_other_ratio():
    """To the last bit, of two materials; in plane stress nothing else changes."""
    pair = {"second_body": "deformable", "second_shear_modulus": 6e9}
    base = PAPER_RUN.replaced(height=0.05, block_length=0.6, n_x=40, n_y=4, end_time=0.3, **pair)
    ratios = {"poisson_ratio": NU, "second_poisson_ratio": NU2}
    stress = base.replaced(**(ratios | {"plane": "stress"}))
    strain = base.replaced(**({name: nu / (1.0 + nu) for name, nu in ratios.items()}))
    ours, expected = simulate(stress), simulate(strain)
    for name in ours:
        np.testing.assert_array_equal(ours[name], expected[name], err_msg=name)
    assert '"plane": "stress"' in ours.attrs["parameters"]
    assert fault(base) != fault(base.replaced(plane="stress"))


def test_other_planes_are_refused():
    refused = "plane = 'mode III' is not allowed: .* must be one of strain, stress, antiplane"
    with pytest.raises(ParameterError, match=refused):
        Material(1e9, 0.2, plane="mode III")
    with pytest.raises(ParameterError, match=refused):
        critical_length(**PMMA, poisson_ratio=NU, plane="mode III")
