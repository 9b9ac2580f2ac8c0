"""Where growth begins, over all that is accepted: no window is stepped over, nothing jumps.

Where ``a << zeta`` the growing pair of modes oscillates in a window of lengths of a few per cent.
"""

import numpy as np
import pytest
from asked import critical_length, stability_length
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from nucleation.api import Fault
from nucleation.run.run import PAPER_RUN
from nucleation.theory.creep import front, lengths
from nucleation.theory.creep.front import first_growing
from nucleation.theory.creep.lengths import Patches, stability_point
from nucleation.theory.evaluation import single_system
from nucleation.theory.status import NoLength

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
        "shear_modulus": 3e9, "poisson_ratio": 0.3, "normal_stress": 1e6, "slip_distance": 1e-6,
        "a": DIRECT, "zeta": ratio * DIRECT, "friction": friction, "height": height * scale,
    } | BODIES[bodies]  # fmt: skip


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
        ({"shear_modulus": 30e9, "poisson_ratio": 0.25, "normal_stress": 50e6, "friction": 0.65,
          "slip_distance": 5e-6, "a": 1.5e-5, "zeta": 400 * 1.5e-5, "height": 5e-3}, 0.4947),
        ({"shear_modulus": 3.1e9, "poisson_ratio": 1 / 3, "normal_stress": 1e6, "friction": 0.41,
          "slip_distance": 5e-7, "a": 1.56e-4, "zeta": 0.0156, "height": 1e-3,
          "second_shear_modulus": np.inf}, 0.4934),
    ],
)  # fmt: skip
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
    with pytest.raises(NoLength, match=r"no patch up to 0\.3 L_c = .* m has a growing mode"):
        stability_point(patches, critical)
