"""The bridge: the finite elements and the time integration against the linear theory, Eq. (5)."""

import io
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from two_bodies import RIGID, transfer_functions
from two_bodies import Body as Layer

from benchmarks.manufactured.orders import orders
from nucleation.fem.body import Body
from nucleation.fem.grid import Grid
from nucleation.fem.operator import Operator
from nucleation.model.material import Material
from nucleation.run.run import PAPER_RUN
from nucleation.theory.critical import unstable_modes
from nucleation.theory.evaluation import single_system
from replication.claims import printed
from replication.claims.pairs import measured_response
from replication.tables import modes as tables
from replication.tables.modes import sliding_period, sliding_state

REFERENCE = Path(__file__).parents[2] / "results" / "reference"
MATERIAL = Material(3.1e9, 0.29, 1200.0)
PARAMETERS = PAPER_RUN
AGREEMENT = 3e-3  # of the complex growth rate, relative; 1 % is asked for


# -- the block's condensed stiffness and the transfer functions of Eq. (10) ----------------------


BELOW = Material(9.0e9, 0.21, 2700.0)


@pytest.mark.parametrize(
    ("layer_number", "bottom", "bound"),
    [
        (0.1, None, 1.5e-4),
        (1.0, None, 1.5e-4),
        (3.0, None, 3e-4),
        (10.0, None, 5e-3),
        *((1.0, bottom, 5e-4) for bottom in ("free", "clamped", "roller")),
    ],
)
def test_condensed_stiffness_converges_to_the_transfer_functions(layer_number, bottom, bound):
    """Per mode ``D = mu k G1 dx`` and ``N = mu k G2 dx``, with second order in h."""
    errors, k = [], 1.5 * np.pi  # of the mode m = 1 of a block of 1 m
    height, lower = layer_number / k, 1.6 * layer_number / k
    second = RIGID if bottom is None else Layer(BELOW, lower, bottom)
    exact = transfer_functions(k, Layer(MATERIAL, height, "free"), second)
    for n in (16, 32, 64, 128):
        above, below = (Grid(1.0, h, n_x=n, n_y=n // 2) for h in (height, lower))
        layers = [(above, MATERIAL)] if bottom is None else [(above, MATERIAL), (below, BELOW)]
        modal = Operator(Body(*layers, far_side=bottom or "free"), 0.0).modal
        found = modal[:, 1] / (MATERIAL.shear_modulus * k * above.dx)
        errors.append(np.abs(found - np.array(exact)).max() / exact[0])
    np.testing.assert_allclose(orders(errors)[1:], 2.0, atol=0.1)
    assert errors[-1] < bound


# -- the time integration and Eq. (5) ------------------------------------------------------------


def theory(parameters, ratio):
    """k (1/m) of a ratio to the critical one, and both rates by Eq. (5)."""
    own = single_system(parameters.fault)
    k = ratio * float(unstable_modes(own).wavenumber[0])
    return k, own.growth_rates(np.array([k]))[:, 0]


SETTINGS = {
    "slip law": PARAMETERS.replaced(evolution="slip", height=0.1),
    "antiplane": PARAMETERS.replaced(plane="antiplane", height=0.1),
}


@pytest.mark.parametrize(
    ("setting", "ratio"), [("slip law", 0.9), ("antiplane", 0.9), ("antiplane", 1.2)]
)
def test_modes_grow_as_the_theory_says(setting, ratio):
    parameters = SETTINGS[setting]
    k, expected = theory(parameters, ratio)
    found = tables.measured_rates(parameters, k)
    found, expected = (rates[np.argsort(rates.imag)] for rates in (found, expected))
    assert np.abs(found - expected).max() < AGREEMENT * np.abs(expected).min()
    assert (found.real.max() > 0.0) == (ratio < 1.0)


@pytest.mark.parametrize(
    ("height", "ratio"),
    [
        (0.1, 0.97),
        (0.1, 1.25),
        *(pytest.param(h, 1.03, marks=pytest.mark.slow) for h in (0.005, 0.5)),
    ],
)
def test_table_of_modes_is_that_of_the_reference_and_the_theorys(monkeypatch, height, ratio):
    monkeypatch.setattr(tables, "HEIGHTS", [height])
    monkeypatch.setattr(tables, "MODES", [ratio])
    made = tables.dispersion_files(PARAMETERS)
    assert dict(made[".nc"].sizes) == {"run": 1, "branch": 2}
    k, expected = theory(PARAMETERS.replaced(height=height), ratio)
    now = pd.read_csv(io.StringIO(made[".csv"]))
    np.testing.assert_allclose(now["mode_wavenumber"], k, rtol=1e-6)
    # the wave along +x, of the larger frequency, comes first
    rates = now["theory_growth"] + 1j * now["theory_frequency"]
    np.testing.assert_allclose(rates, expected[np.argsort(-expected.imag)], rtol=1e-6)
    rates = now["measured_growth"] + 1j * now["measured_frequency"]
    assert (np.abs(rates / expected[np.argsort(-expected.imag)] - 1.0) < AGREEMENT).all()
    stored = pd.read_csv(REFERENCE / "dispersion.csv")
    assert list(now) == list(stored)
    at = np.isclose(stored["height"], height)
    stored = stored[at & np.isclose(stored["wavenumber_over_critical"], ratio)]
    names = ["measured_growth", "measured_frequency", "theory_growth", "theory_frequency"]
    np.testing.assert_allclose(now[names], stored[names], rtol=1e-4)


# -- two layers ----------------------------------------------------------------------------------


def rates_of(modes):
    """The measured rates, and those by Eq. (5)."""
    return [
        modes[f"{kind}_growth"].values + 1j * modes[f"{kind}_frequency"].values
        for kind in ("measured", "theory")
    ]


LAYERS = tables.THIN_LAYERS | tables.HALF_SPACES
QUICK = ("stiff above, free", "stiff below, clamped", "stiff above, roller")


@pytest.mark.parametrize(
    "which",
    [name if name in QUICK else pytest.param(name, marks=pytest.mark.slow) for name in LAYERS],
)
@pytest.mark.parametrize("ratio", [0.8, pytest.param(1.25, marks=pytest.mark.slow)])
def test_modes_of_a_pair_grow_and_turn_as_the_theory_says(which, ratio):
    """Both roots: the wave along +x and the one along -x, which the contrast tells apart."""
    modes = tables.pair_modes(PARAMETERS, {which: LAYERS[which]}, (ratio,)).isel(run=0)
    found, expected = rates_of(modes)
    error = np.abs(found - expected) / np.abs(expected)
    assert error.max() < 5e-3  # 1 % is asked for
    assert (found.real.max() > 0.0) == (ratio < 1.0)
    assert abs(expected[0].imag + expected[1].imag) > 1e-3 * abs(expected[0])  # they differ


SLIDING = {"one": PARAMETERS, "pair": PARAMETERS.replaced(**LAYERS["stiff above, free"])}


@pytest.mark.parametrize("parameters", SLIDING.values(), ids=SLIDING)
def test_homogeneous_sliding_persists(parameters):
    """With sigma0 on the interface, also where nothing holds the mean."""
    parameters = tables.one_wavelength(parameters.replaced(height=0.2), 20.0, nodes=17)
    dynamics = sliding_period(parameters)
    state = sliding_state(dynamics, np.zeros(17))
    for _ in range(40):
        state, report = dynamics.advance(state, -45)
    np.testing.assert_allclose(report.interface.slip_rate, 1e-5, rtol=1e-7)
    np.testing.assert_allclose(report.interface.normal[1:], 1e6 * dynamics.grid.dx, rtol=1e-9)


def test_a_mode_that_travels_back_is_told_apart_by_the_sense():
    """Swapped layers: what went along +x goes along -x, G2 changing sign and G1 not."""
    swapped = dict(list(tables.HALF_SPACES.items())[:2])
    modes = tables.pair_modes(PARAMETERS, swapped, (0.8,))
    g1, g2 = measured_response(modes)
    modulus = modes["shear_modulus"].values[:, None]
    # Poisson's ratios are not swapped, so that the formulas are to be asked
    for i, layers in enumerate(swapped.values()):
        psi = layers["second_shear_modulus"] / layers["shear_modulus"]
        nu = layers["poisson_ratio"], layers["second_poisson_ratio"]
        expected = printed.bimaterial_transfer(psi, *nu)
        np.testing.assert_allclose(g1[i], expected[0], rtol=5e-3)
        np.testing.assert_allclose(g2[i], expected[1], rtol=1e-2)
    assert g2[0, 0] * g2[1, 0] < 0.0 < (modulus * g1).min()
