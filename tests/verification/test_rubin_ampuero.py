"""The patch of fixed length of Rubin and Ampuero (2005), simulated in its own setting.

Two tall identical bodies, periodic, under a far stress that rises; the aging law with constant a
and b; hardly any inertia, which would widen the patch. It begins where f is lower: that moves no
L_b, as a lower normal stress would (by 5 % for 5 %). The length is read at half the largest slip
rate: the edges of the solution's ``|x| < 1.3774 L_b`` are beyond what a slip rate shows.
"""

import math

import numpy as np
import pytest
from theory.test_literature import crack_coefficients

from nucleation.analysis.literature import DEFINITIONS
from nucleation.model.friction.law import Friction
from nucleation.model.heterogeneity import Heterogeneity
from nucleation.model.material import Material
from nucleation.model.parameters import Geometry, Loading, Mesh, Parameters, Stepping
from nucleation.model.second_body import SecondBody
from nucleation.simulation.run import run
from nucleation.theory.literature_table import lengths_in_use

B, STATE_LENGTH, PERIOD = 0.02, 3.1e9 / (1 - 1 / 3) * 5e-7 / (0.02 * 1e6), 16


def parameters(ratio, n_x, change):
    friction = Friction(law="dieterich_ruina", evolution="aging")
    length = PERIOD * STATE_LENGTH
    return Parameters(
        material=Material(density=1.0),
        friction=friction.with_expansion(1e-5, 0.4, ratio * B, (1 - ratio) * B),
        loading=Loading(kind="remote", stress_rate=1e5),
        geometry=Geometry(length / 2, length),
        mesh=Mesh(n_x, 32, 64.0),
        stepping=Stepping(end_time=1e3, longest_step=0.2),
        second_body=SecondBody(kind="deformable"),
        heterogeneity=Heterogeneity(varies="f", change=change, width=2 * STATE_LENGTH),
    )


def width(slip_rate, element):
    """Width (m) at half the maximum, between nodes in log v; the maximum is in the middle."""
    height = np.log(2.0 * slip_rate / slip_rate.max())
    inside = np.flatnonzero(height > 0.0)
    first, last = inside[[0, -1]]
    left = height[first] / (height[first] - height[first - 1])
    right = height[last] / (height[last] - height[last + 1])
    return element * (last - first + left + right)


def width_over_length():
    """The solution's width at half its maximum over its length."""
    n, c = crack_coefficients(1.3774)
    x = np.linspace(0.0, 0.999, 2000)
    v = np.sin(np.outer(np.arccos(x), n)) @ c
    return np.interp(-0.5, -v / v[0], x)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("ratio", "n_x", "change"), [(0.1, 161, -0.02), (0.3, 161, -0.05), (0.3, 321, -0.05)]
)
def test_fixed_length(ratio, n_x, change):
    own = parameters(ratio, n_x, change)
    for instant in run(own):
        slip_rate = instant.report.interface.slip_rate[:n_x]
        if slip_rate.max() > 1e-2:
            break
    found = width(slip_rate, own.geometry.length / n_x) / width_over_length()
    fault = {"shear_modulus": 3.1e9, "poisson_ratio": 1 / 3, "normal_stress": 1e6, "b": B}
    lengths = lengths_in_use(**fault, a=ratio * B, slip_distance=5e-7)
    expected = float(lengths["rubin_ampuero_localised"])
    assert math.isclose(found, expected, rel_tol=0.03)


def test_the_table_of_the_literature_reads_the_same_part_of_the_length():
    part = DEFINITIONS["rubin_ampuero_localised"].part
    assert math.isclose(part, width_over_length(), rel_tol=1e-3)
