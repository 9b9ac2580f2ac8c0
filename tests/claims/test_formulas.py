"""The paper's formulas and the library against evaluations that use neither.

Navier's equation with 150 digits (theory/layer_problem.py) gives the transfer functions, a search
for growing roots of Eq. (5) (search.py) the critical wavenumbers, for printed formulas and library.
"""

from decimal import Decimal

import numpy as np
import pytest
import search
from reference_evidence import evidence, judged
from scipy.optimize import brentq
from theory.layer_problem import compliance, mode_rows, solve

from replication.claims import printed, theory
from replication.claims.verdicts import Verdict

NU = 1.0 / 3.0
WEAKENINGS = evidence().theory["zeta_over_a"].values
HALF_SPACE = 120.0  # kH


def layer(q, nu=NU, modulus=1.0, far_side="velocity"):
    """The compliance of a layer of kH = q, in units of 1/k and the upper modulus."""
    return np.array(compliance(1.0, q, modulus, nu, far_side))


def transfer(upper, lower=0):
    """G1 and G2 of two layers by their compliance."""
    ((t, n),) = solve((upper - lower).tolist(), [[Decimal(1), Decimal(0)]])
    return -float(t), float(n)


def half_spaces(nu, psi=1.0, nu2=NU):
    return transfer(layer(HALF_SPACE, nu), layer(-HALF_SPACE, nu2, psi))


def block_transfer(q):
    """G1 and G2 of a block on a rigid base, free of stress on top."""
    return transfer(layer(min(q, HALF_SPACE), far_side="free"))


def matrix(compliance):
    """M of ``u_i = M_ij sigma_yj``, with ``u_y = i W`` and ``sigma_yy = i N``."""
    return compliance.astype(float) * [[1.0, -1j], [1j, 1.0]]


def block_field(q, y):
    """U and W at the heights y of a block on a rigid base that slips by one."""
    rows = [mode_rows(Decimal(1), Decimal(float(at)), Decimal(1), Decimal(NU)) for at in (0, q, *y)]
    near, far = rows[:2]
    conditions = [near["u"], near["w"], far["t"], far["n"]]
    ((*amplitudes,),) = solve(conditions, [[Decimal(x) for x in (1, 0, 0, 0)]])
    return [
        np.array([row[name] for row in rows[2:]], float) @ np.array(amplitudes, float)
        for name in "uw"
    ]


def linearised(law, velocity):
    """``[[f_v, f_phi], [g_v, g_phi]]`` at steady sliding, by central differences (SI units)."""
    state = float(law.steady_state(velocity))
    columns = []
    for dv, dphi in ((1e-5 * velocity, 0.0), (0.0, 1e-5 * state)):
        ends = (velocity + dv, state + dphi), (velocity - dv, state - dphi)
        change = [f(*ends[0]) - f(*ends[1]) for f in (law.coefficient, law.state_rate)]
        columns.append(np.array(change) / (2.0 * (dv + dphi)))
    return np.transpose(columns)


def test_spring_block_is_unstable_below_the_printed_stiffness():
    """The stiffness at which a root of the linearised law and spring gets a positive real part."""
    on = evidence()
    law, velocity = on.friction, on.velocity
    (f_v, f_phi), (g_v, g_phi) = linearised(law, velocity)

    def growth(stiffness):
        # K dx + f_v dv + f_phi dphi = 0 per normal force, dx' = dv, dphi' = g_v dv + g_phi dphi
        dv = np.array([-stiffness / f_v, -f_phi / f_v])
        matrix = np.array([dv, g_v * dv + [0.0, g_phi]])
        return np.linalg.eigvals(matrix).real.max()

    expected = law.expansion(velocity).zeta / law.slip_distance
    found = brentq(growth, 0.2 * expected, 5.0 * expected, rtol=1e-12)
    assert found == pytest.approx(expected, rel=1e-6)


def test_perturbed_friction_is_the_printed_one():
    on = evidence()
    law, velocity = on.friction, on.velocity
    ell = law.slip_distance
    _, a, zeta = law.expansion(velocity)
    (f_v, f_phi), (g_v, g_phi) = linearised(law, velocity)
    for relative in (0.3 + 1j, 0.1 + 2j, 1j):
        rate = relative * velocity / ell
        ours = rate * (f_v + f_phi * g_v / (rate - g_phi))
        expected = rate * (a * rate * ell - zeta * velocity) / (velocity * (velocity + rate * ell))
        assert ours == pytest.approx(expected, rel=1e-6)


@pytest.mark.parametrize("pair", theory.PAIRS)
def test_two_half_spaces(pair):
    """Eqs. (7) and (8), by formula, library and Navier's equation."""
    psi, nu, nu2 = pair
    expected = half_spaces(nu, psi, nu2)
    assert printed.bimaterial_transfer(*pair) == pytest.approx(expected, rel=1e-10)
    on = evidence()
    modulus = psi * on.material.shear_modulus
    changes = {"second_shear_modulus": modulus, "second_poisson_ratio": nu2}
    found = theory.main_text(on, poisson_ratio=nu, **changes).transfer_functions(1.0)
    assert found == pytest.approx(expected, rel=1e-10)


def test_identical_and_mirrored_bodies_are_not_coupled():
    assert half_spaces(NU) == pytest.approx((1.0 / (2.0 * (1.0 - NU)), 0.0), abs=1e-10)
    for q in (0.1, 1.0, 3.0):
        layers = theory.main_text(evidence(), height=q, second_height=q, far_side="velocity")
        found = layers.replace(second_far_side="velocity").transfer_functions(1.0)
        assert transfer(layer(q), layer(-q)) == pytest.approx(found, abs=1e-9)


@pytest.mark.parametrize("q", [1e-3, *theory.LAYER_NUMBERS, HALF_SPACE])
def test_block_on_a_rigid_base(q):
    """Eq. (10) and its limits, by formula, library and Navier's equation."""
    expected = block_transfer(q)
    assert theory.block(evidence(), q).transfer_functions(1.0) == pytest.approx(expected, rel=1e-6)
    if q > 0.01:  # thinner, the printed formula cancels
        assert printed.block_transfer(q, NU) == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("q", [0.3, 1.0, 3.0, 10.0])
def test_response_matrix_and_field(q):
    """A half-space's matrix is that of a thick layer."""
    thick = matrix(layer(HALF_SPACE))
    np.testing.assert_allclose(printed.half_space_response(NU), thick, atol=1e-10)
    ours = matrix(layer(q))
    np.testing.assert_allclose(printed.response_matrix(q, NU), ours, rtol=1e-8, atol=1e-8)
    y = np.linspace(0.0, q, 9)
    u, w = block_field(q, y)
    field = printed.block_field(q, y / q, NU)
    np.testing.assert_allclose(field / field[0, 0], [u, 1j * w], atol=1e-9)


def test_the_librarys_critical_wavenumber_is_the_one_found_by_search():
    """Identical half-spaces, and a thin and a high block; G1 and G2 by Navier's equation."""
    on = evidence()
    at, modulus = on.interface, on.base.fault.shear_modulus
    curve = on.theory
    mode = theory.main_text(on).critical_mode()
    identical = half_spaces(NU)
    cases = [(lambda k: identical, mode.wavenumber, mode.angular_frequency)]
    for i in (0, -1):
        own = curve.isel(height=i)
        height = float(own["height"])
        numbers = (float(own[f"critical_{name}"]) for name in ("wavenumber", "frequency"))
        cases.append((lambda k, h=height: block_transfer(k * h), *numbers))
    for transfer, wavenumber, frequency in cases:
        k, rate = search.critical_wavenumber(transfer, modulus, at, 2.0 * wavenumber)
        assert k == pytest.approx(wavenumber, rel=1e-8)
        assert rate * at.velocity / at.slip_distance == pytest.approx(abs(frequency), rel=1e-6)
        short = [search.growth_at(k * r, transfer, modulus, at).real for r in (1.001, 1.1, 10.0)]
        assert max(short) < 0.0


@pytest.mark.parametrize("f_beta", theory.CONTRASTS)
def test_length_of_two_half_spaces(f_beta):
    """Eq. (9), and Eq. (6) with M for no contrast."""
    for z in WEAKENINGS:
        expected = printed.bimaterial_ratio(f_beta, z)
        assert z / search.half_space_load(f_beta, 1.0, z) == pytest.approx(expected, rel=1e-9)
        assert z / search.half_space_load(0.0, 1.0, z) == pytest.approx(1.0, rel=1e-9)


@pytest.mark.parametrize(("a", "zeta"), theory.STRENGTHENING)
def test_velocity_strengthening(a, zeta):
    threshold = printed.strengthening_threshold(a, zeta)
    assert search.strengthening_threshold(a, zeta) == pytest.approx(threshold, rel=1e-7)
    for factor in (1.2, 2.0):
        ours = zeta / search.half_space_load(factor * threshold, a, zeta)
        expected = printed.bimaterial_ratio(factor * threshold, zeta / a)
        assert ours == pytest.approx(expected, rel=1e-9)


def test_theory_by_hand():
    """The main text's numbers put into the formulas by hand."""
    expected = {
        "half-spaces-wavenumber": 2 * (2 / 3) * 0.016 * 1e6 / 3.1e9 / 0.5e-6,
        "eta": 1.5 * np.pi,
        "uncoupled-frequency": np.sqrt(0.016 / 0.0068) * 20.0,
        "half-spaces-g1": 0.75,
        "block-high-limit": 0.25,
    }
    on = evidence()
    found = {id: judged(id, on)["ours"] for id in expected}
    assert found == pytest.approx(expected, rel=1e-6)


def factors(g1, g2):
    """A change of transfer functions by factors."""
    return lambda transfer: lambda *case: np.array(transfer(*case)) * (g1, g2)


WRONG = [
    ("block_transfer", factors(1.001, 1.0), "block-g1"),
    ("block_transfer", factors(1.0, 0.999), "block-g2"),
    ("bimaterial_transfer", factors(1.0, 1.001), "bimaterial-g2"),
    ("bimaterial_ratio", lambda f: lambda rho, z: f(rho, 1.001 * z), "bimaterial-length"),
    ("strengthening_threshold", lambda f: lambda *c: 0.999 * f(*c), "strengthening-threshold"),
    ("response_matrix", lambda f: lambda q, nu: f(q, 1.001 * nu), "response-matrix"),
    ("block_field", lambda f: lambda q, y, nu: f(q, y, 1.001 * nu), "block-field"),
]


@pytest.mark.parametrize(("name", "change", "id"), WRONG)
def test_wrong_formula_is_not_replicated(monkeypatch, name, change, id):
    assert judged(id, evidence())["verdict"] == Verdict.REPLICATED
    monkeypatch.setattr(printed, name, change(getattr(printed, name)))
    assert judged(id, evidence())["verdict"] == Verdict.NOT_REPLICATED


def test_a_longer_thin_limit_is_not_replicated(monkeypatch):
    longer = theory.thin_limit_length
    monkeypatch.setattr(theory, "thin_limit_length", lambda *case: 1.02 * longer(*case))
    assert judged("thin-length", evidence())["verdict"] == Verdict.NOT_REPLICATED


def test_rubin_and_ampueros_length_is_the_one_that_the_note_has():
    """And it is outside the range of eta that the paper has for the conventional approach."""
    on = evidence()
    _, a, zeta = on.friction.expansion(on.velocity)
    fault = theory.main_text(on, a=a, zeta=zeta)
    found = fault.literature()["rubin_ampuero_localised"].value
    scale = fault.shear_modulus * fault.slip_distance / (fault.zeta * fault.normal_stress)
    assert found / scale > 4.0 / 3.0
    assert rf"$\eta = {found / scale:.2f}$" in judged("literature-eta", on)["reason"]
