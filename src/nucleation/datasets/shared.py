"""Variables that describe the fault in the tables of several wings.

:mod:`nucleation.simulation.recorded` declares the variables that a simulation records, so that no
simulation depends on this module.
"""

from .variables import Variable

SHARED = {
    "id": Variable("", "name of the simulation"),
    "height": Variable("m", "block height", "H"),
    "n_x": Variable("1", "number of elements along x", "N_x"),
    "n_y": Variable("1", "number of elements along y", "N_y"),
    "slip_distance": Variable("m", "characteristic slip distance", "D"),
    "velocity": Variable("m/s", "imposed velocity", "V"),
    "normal_stress": Variable("Pa", "compressive stress on the top", "sigma0"),
    "shear_modulus": Variable("Pa", "shear modulus", "mu"),
    "poisson_ratio": Variable("1", "Poisson's ratio", "nu"),
    "plane": Variable("", "plane of deformation, strain or stress"),
    "a": Variable("1", "direct effect at V", "a"),
    "zeta": Variable("1", "velocity weakening at V", "zeta"),
    "width": Variable("m", "width of the change along the interface, of a bump half-way", "W"),
    "zeta_over_a": Variable("1", "velocity weakening over direct effect", "zeta/a"),
    "friction": Variable("1", "friction coefficient of steady sliding at V", "f"),
    "f_beta": Variable("1", "friction coefficient times bimaterial contrast", "f beta"),
    "far_side": Variable("", "far side of the second body"),
    "second_height": Variable("m", "height of the second body", "H2"),
    "second_shear_modulus": Variable("Pa", "shear modulus of the second body", "mu2"),
    "second_poisson_ratio": Variable("1", "Poisson's ratio of the second body", "nu2"),
}
