"""L_s of one fault and of many, against simulations and under changes that leave it alone."""

import dataclasses

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from asked import lengths_in_use, stability_length
from configurations import CONFIG
from parts import law_values

from nucleation.api import Fault, Friction, ParameterError
from nucleation.run.run import PAPER_RUN
from nucleation.theory.creep.lengths import (
    Patches,
    stability_answers,
    stability_length_of,
    stability_point,
)
from nucleation.theory.evaluation import evaluate
from nucleation.theory.status import NoLength

REFERENCE = CONFIG.parent / "results" / "reference"
FAULT = {
    "shear_modulus": 3.1e9, "poisson_ratio": 1 / 3, "second_shear_modulus": np.inf,
    "friction": 0.41, "a": 0.0068, "slip_distance": 5e-7, "normal_stress": 1e6, "velocity": 1e-5,
}  # fmt: skip


def test_the_map():
    """Constant a and b: a per cent short of the simulations, whose fronts are no sharp ends."""
    table = pd.read_csv(REFERENCE / "map.csv").groupby(["height", "zeta_over_a"])
    simulated = table["stability_length"].mean()
    height, ratio = (simulated.index.get_level_values(n).to_numpy() for n in simulated.index.names)
    found = stability_length(**FAULT, height=height, zeta=ratio * FAULT["a"])
    off = found / simulated.to_numpy() - 1.0
    assert np.sqrt(np.mean(off**2)) < 0.012
    assert off.min() > -0.033 and off.max() < 0.0


def test_numbers_of_modes():
    """The error that is given covers what twice as many modes change."""
    for height, ratio, below in ((0.005, 2.288, np.inf), (0.1, 6.0, np.inf), (0.5, 1.0, 3.1e8)):
        fault = Fault(
            **FAULT | dict(height=height, zeta=ratio * 0.0068, second_shear_modulus=below)
        )
        length, error = stability_answers(fault)[:2]
        assert error < 1e-3

        def finer(systems, length=length):
            patches = Patches(systems)
            growth = patches.at(float(length), 2 * patches.number).eigenvalues[0].real
            around = [patches.at(float(length) * x).eigenvalues[0].real for x in (0.999, 1.001)]
            return np.full(systems.a.size, growth * 0.002 / (around[1] - around[0]))

        assert abs(evaluate(fault, finer)) < max(float(error), 5e-4)


def test_only_ratios_matter():
    """Of moduli to stresses, of lengths to one another, and the velocity not at all."""
    plain = stability_length(**FAULT, zeta=0.016, height=0.05)
    scaled = FAULT | {"shear_modulus": 3.1e10, "normal_stress": 1e7, "velocity": 1e-3}
    assert stability_length(**scaled, zeta=0.016, height=0.05) == pytest.approx(plain, rel=1e-6)
    longer = FAULT | {"slip_distance": 5e-6}
    assert stability_length(**longer, zeta=0.016, height=0.5) == pytest.approx(10 * plain, rel=1e-6)


def test_arrays_keep_their_names():
    height = xr.DataArray([0.01, 0.05], dims="height")
    zeta = xr.DataArray([0.01, -0.01, 0.02], dims="zeta")
    found = stability_length(**FAULT, height=height, zeta=zeta)
    assert found.sizes == {"height": 2, "zeta": 3} and found.attrs["units"] == "m"
    assert np.isnan(found.sel(zeta=1)).all() or found.isel(zeta=1).isnull().all()
    alone = stability_length(**FAULT, height=0.05, zeta=0.02)
    assert float(found[1, 2]) == pytest.approx(float(alone))
    plain = stability_length(**FAULT, height=[[0.01], [0.05]], zeta=[0.01, -0.01, 0.02])
    assert plain.shape == (2, 3)


def test_modes_are_doubled_where_they_do_not_resolve_the_patch():
    """16, 32, 64 and 256 modes give 1.796, 1.8128, 1.8130 and 1.8130 L_c."""
    fault = Fault(
        shear_modulus=3.1e9, poisson_ratio=1 / 3, friction=0.41, a=0.0068, zeta=0.00068,
        slip_distance=5e-7, normal_stress=1e6,
    )  # fmt: skip
    length, error = stability_answers(fault)[:2]
    assert float(length / fault.critical_length()) == pytest.approx(1.8130, rel=3e-4)
    assert error < 1e-3


def test_a_law_without_scales_is_one_of_constants():
    law = Friction(law="dieterich_ruina", regularisation_slip_rate=1e-16)
    fault = FAULT | {"height": 0.03, "zeta": 0.016}
    assert stability_length(**fault, friction_law=law) == pytest.approx(
        stability_length(**fault), rel=2e-3
    )
    with pytest.raises(ParameterError, match="velocity"):
        stability_length(**fault | {"velocity": None}, friction_law=law)


@pytest.mark.parametrize(("ratio", "percent"), [(1.0, 13), (2.2883, 5)])
def test_other_coefficients_at_the_slow_front_shorten_the_patch(ratio, percent):
    """By as much as docs/creeping_patch.md has for ten times v*."""
    law = Friction(law="product", slip_rate_scale=1e-6, regularisation_slip_rate=1e-12)
    law = law.with_expansion(1e-5, 0.41, 0.0068, 0.0068 * ratio)
    run = PAPER_RUN.replaced(height=0.03, **law_values(law))
    critical, patches = run.critical_length, dataclasses.replace(run.patches, law=None)
    own, constant = (stability_length_of(one, critical) for one in (run.patches, patches))
    assert 1.0 - own / constant == pytest.approx(0.01 * percent, abs=5e-3)


def test_no_patch():
    assert np.isnan(stability_length(**FAULT, height=0.1, zeta=-0.001))
    with pytest.raises(NoLength, match="stable"):
        stability_point(PAPER_RUN.patches, np.nan)
    with pytest.raises(ParameterError, match=r"loading = 'side' .* one of edge, remote"):
        stability_length(**FAULT, height=0.1, zeta=0.01, loading="side")
    with pytest.raises(ParameterError, match="friction_law is not allowed with loading = remote"):
        stability_length(**FAULT, zeta=0.01, friction_law=Friction(law="product"), loading="remote")


@pytest.mark.parametrize("ratio", [0.3, 1.0, 2.288, 6.0])
def test_a_patch_in_the_interior_of_a_full_space(ratio):
    """It is the pinned patch under a rising load, solved otherwise in answers/finite_patch.py."""
    fault = FAULT | {"second_shear_modulus": None, "zeta": ratio * FAULT["a"]}
    expected = float(lengths_in_use(**fault)["loaded_patch"])
    assert stability_length(**fault, loading="remote") == pytest.approx(expected, rel=1e-5)


def test_where_a_patch_begins():
    """From the loading; its slip rate from the load's rise."""
    assert PAPER_RUN.patches.loading == "edge"
    run = PAPER_RUN.replaced(height=0.1, block_length=1.0).replaced(
        loading="remote", stress_rate=1e5
    )
    assert run.patches.loading == "remote"
    # a crack of half-spaces has v(0) = L (dtau/dt)/mu*
    half_spaces = run.replaced(height=100.0, second_body="deformable", n_x=101)  # fmt: skip
    star = run.fault.shear_modulus / (1.0 - run.fault.poisson_ratio)
    fastest = half_spaces.patches.creep(0.4).fastest * run.fault.velocity
    assert fastest == pytest.approx(0.4 * 1e5 / star, rel=3e-3)
