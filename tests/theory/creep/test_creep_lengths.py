"""L_s of one fault and of many: against simulations, under changes, over all that is accepted.

Where ``a << zeta`` the growing pair of modes oscillates in a window of lengths of a few per cent.
"""

import dataclasses

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from asked import critical_length, lengths_in_use, stability_length
from configurations import CONFIG
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from nucleation.api import Fault, Friction, ParameterError
from nucleation.run.run import PAPER_RUN
from nucleation.theory.creep import front, lengths
from nucleation.theory.creep.front import first_growing
from nucleation.theory.creep.lengths import (
    Patches,
    stability_answers,
    stability_length_of,
    stability_point,
)
from nucleation.theory.evaluation import evaluate, single_system
from nucleation.theory.status import NoLength

REFERENCE = CONFIG.parent / "results" / "reference"
FAULT = {
    "shear_modulus": 3.1e9,
    "poisson_ratio": 1 / 3,
    "second_shear_modulus": np.inf,
    "friction": 0.41,
    "a": 0.0068,
    "slip_distance": 5e-7,
    "normal_stress": 1e6,
    "velocity": 1e-5,
}


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
        shear_modulus=3.1e9,
        poisson_ratio=1 / 3,
        friction=0.41,
        a=0.0068,
        zeta=0.00068,
        slip_distance=5e-7,
        normal_stress=1e6,
    )
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
    run = PAPER_RUN.replaced(height=0.03, friction_law=law)
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
    half_spaces = run.replaced(height=100.0, second_body="deformable", n_x=101)
    star = run.fault.shear_modulus / (1.0 - run.fault.poisson_ratio)
    fastest = half_spaces.patches.creep(0.4).fastest * run.fault.velocity
    assert fastest == pytest.approx(0.4 * 1e5 / star, rel=3e-3)


DIRECT = 1e-4  # a of the faults below
SOFTNESS = 3e9 * 1e-6 / 1e6  # mu D/sigma0 (m)

BODIES = {
    "rigid base": {"second_shear_modulus": np.inf},
    "identical": {},
    "softer above": {"second_shear_modulus": 1.5e10},
    "softer below": {"second_shear_modulus": 1e9},
    "pushed top": {"second_shear_modulus": np.inf, "far_side": "velocity"},
}


def fault(ratio, height, bodies, friction=0.5):
    """One of zeta/a = `ratio`, with a height over mu D/(zeta sigma0)."""
    scale = SOFTNESS / (ratio * DIRECT)
    return {
        "shear_modulus": 3e9,
        "poisson_ratio": 0.3,
        "normal_stress": 1e6,
        "slip_distance": 1e-6,
        "a": DIRECT,
        "zeta": ratio * DIRECT,
        "friction": friction,
        "height": height * scale,
    } | BODIES[bodies]


def patches_of(parameters):
    """The patches of one fault, and its L_c (m)."""
    own = Fault(**parameters)
    return Patches(single_system(own)), float(own.critical_length())


def ratio_of(parameters):
    return float(stability_length(**parameters)) / float(critical_length(**parameters))


@pytest.mark.parametrize(
    ("own", "expected"),
    [
        # both by an independent eigenproblem
        (
            {
                "shear_modulus": 30e9,
                "poisson_ratio": 0.25,
                "normal_stress": 50e6,
                "friction": 0.65,
                "slip_distance": 5e-6,
                "a": 1.5e-5,
                "zeta": 400 * 1.5e-5,
                "height": 5e-3,
            },
            0.4947,
        ),
        (
            {
                "shear_modulus": 3.1e9,
                "poisson_ratio": 1 / 3,
                "normal_stress": 1e6,
                "friction": 0.41,
                "slip_distance": 5e-7,
                "a": 1.56e-4,
                "zeta": 0.0156,
                "height": 1e-3,
                "second_shear_modulus": np.inf,
            },
            0.4934,
        ),
    ],
)
def test_a_narrow_window_is_not_stepped_over(own, expected):
    assert ratio_of(own) == pytest.approx(expected, rel=1e-3)


FAULTS = st.tuples(
    st.floats(-0.5, 3.0).map(lambda log: 10.0**log),
    st.one_of(st.just(np.inf), st.floats(-3.0, 2.0).map(lambda log: 10.0**log)),
    st.sampled_from(list(BODIES)),
    st.floats(0.0, 0.9),
).filter(lambda drawn: drawn[2] != "pushed top" or drawn[1] > 2.0)
"""zeta/a, height, bodies, friction; lower layers under a top that moves are stable, or nearly."""


@pytest.mark.slow
@settings(max_examples=40)
@given(FAULTS)
def test_the_shortest_growing_patch(drawn):
    """All shorter patches of a fine grid decay, by the full matrix, and the next longer grows."""
    patches, critical = patches_of(fault(*drawn))
    assume(np.isfinite(critical))
    found, _ = stability_point(patches, critical)
    for length in critical * np.geomspace(0.1, 1.0, 60):
        growth = np.linalg.eigvals(patches.at(length).matrix).real.max()
        if abs(length / found - 1.0) > 1e-3:
            assert (growth > 0.0) == (length > found), length / critical
    assert patches.at(found).eigenvalues[0].imag != 0.0


def assert_smooth(values):
    """Each value is the mean of its neighbours within 2 %; a window stepped over is 100 %."""
    logs = np.log(values)
    assert np.abs(logs[1:-1] - 0.5 * (logs[:-2] + logs[2:])).max() < 0.02


@pytest.mark.slow
@pytest.mark.parametrize("bodies", BODIES)
@pytest.mark.parametrize("height", [0.003, 0.3, np.inf])
def test_continuous_in_weakening(bodies, height):
    """From zeta/a = .3 to 1000, in layers that are thin to thick, and half-spaces."""
    if bodies == "pushed top" and height < 1.0:
        pytest.skip("a thin layer under a top that moves is stable")
    found = [ratio_of(fault(q, height, bodies)) for q in np.geomspace(0.3, 1e3, 40)]
    assert_smooth(found)
    assert (np.diff(found) < 0.0).all()


def narrow_run(zeta):
    """A run whose friction has the least a that its law allows, and its L_c (m)."""
    law = {"friction_law": "dieterich_ruina", "friction": 0.41, "a": 0.0014, "zeta": zeta}
    run = PAPER_RUN.replaced(height=0.01, block_length=3.0, **law)
    return run, run.critical_length


@pytest.mark.slow
@pytest.mark.parametrize("zeta", [0.14, 0.4])
def test_the_front_steps_over_no_window_either(zeta, monkeypatch):
    run, critical = narrow_run(zeta)
    usual = first_growing(run.patches, critical, 1.0)
    for tried in (9, 40):
        monkeypatch.setattr(front, "TRIED", tried)
        assert first_growing(run.patches, critical, 1.0) == pytest.approx(usual, rel=2e-3)
    rates = [
        front.fastest(front.Advance(run.patches, [part * usual], 1.0))[0] for part in (0.99, 1.01)
    ]
    assert rates[0] < 0.0 < rates[1]


def test_no_patch_up_to_the_longest(monkeypatch):
    patches, critical = patches_of(fault(1.0, 1.0, "identical"))
    monkeypatch.setattr(lengths, "LONGEST", 0.3)
    with pytest.raises(NoLength, match=r"no patch up to 0\.3 L_c has a growing mode"):
        stability_point(patches, critical)
