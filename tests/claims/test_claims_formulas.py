"""Independent evaluations agree with exact cases, and a wrong formula is not replicated."""

import numpy as np
import pytest
from reference_evidence import BY_ID, evidence
from theory import layer_problem
from two_bodies import RIGID, Body, critical_wavenumber

from replication.claims.claim import Verdict
from replication.claims.independent import marginal, printed
from replication.claims.independent.elastic_layers import Layer, compliance
from replication.claims.statements import finite_height


@pytest.fixture(scope="module")
def evidence_of_theory():
    return evidence()


@pytest.mark.parametrize("far_side", ["velocity", "traction"])
@pytest.mark.parametrize("q", [0.3, 4.0, -1.0])
def test_compliance_is_that_of_the_general_solution_with_150_digits(q, far_side):
    (xx, xy), (yx, yy) = layer_problem.compliance(1.0, q, 1.0, 0.3, far_side)
    expected = np.array([[float(xx), -1j * float(xy)], [1j * float(yx), float(yy)]])
    ours = compliance(Layer(q, 0.3, far_side=far_side, points=32))
    np.testing.assert_allclose(ours, expected, rtol=1e-8, atol=1e-8)


@pytest.mark.parametrize("height", [0.005, 0.1])
def test_search_finds_the_librarys_critical_wavenumber(evidence_of_theory, height):
    material, interface = evidence_of_theory.material, evidence_of_theory.interface
    point = critical_wavenumber(Body(material, height, "traction"), RIGID, interface)
    k, frequency = marginal.critical_wavenumber(
        lambda k: finite_height.block_transfer(k * height, evidence_of_theory.nu),
        material.shear_modulus,
        interface,
        2.0 * point.wavenumber,
    )
    assert k == pytest.approx(point.wavenumber, rel=1e-8)
    rate = interface.velocity / interface.slip_length
    assert frequency * rate == pytest.approx(abs(point.angular_frequency), rel=1e-7)


def test_search_without_growth_is_an_error():
    with pytest.raises(ValueError, match="no growth in the range of the search"):
        marginal.half_space_load(0.0, a=0.01, zeta=-0.005)


def factors(g1, g2):
    """A change of transfer functions by factors."""

    def change(transfer):
        def changed(q, nu):
            right = transfer(q, nu)
            return right[0] * g1, right[1] * g2

        return changed

    return change


WRONG = [
    ("block_transfer", factors(1.001, 1.0), "block-g1"),
    ("block_transfer", factors(1.0, 0.999), "block-g2"),
    ("bimaterial_ratio", lambda f: lambda rho, z: f(rho, 1.001 * z), "bimaterial-length"),
    (
        "strengthening_threshold",
        lambda f: lambda a, zeta: 0.999 * f(a, zeta),
        "strengthening-threshold",
    ),
    (
        "bimaterial_contrast",
        lambda f: lambda psi, nu1, nu2: 1.001 * f(psi, nu1, nu2),
        "bimaterial-g2",
    ),
    ("response_matrix", lambda f: lambda q, nu: f(q, 1.001 * nu), "response-matrix"),
    ("block_field", lambda f: lambda q, y, nu: f(q, y, 1.001 * nu), "block-field"),
    ("thin_length", lambda f: lambda *a: 1.02 * f(*a), "thin-length"),
]


@pytest.mark.parametrize(("name", "change", "id"), WRONG)
def test_wrong_formula_is_not_replicated(monkeypatch, evidence_of_theory, name, change, id):
    claim = BY_ID[id]
    assert claim.evaluate(evidence_of_theory)["verdict"] == Verdict.REPLICATED
    monkeypatch.setattr(printed, name, change(getattr(printed, name)))
    assert claim.evaluate(evidence_of_theory)["verdict"] == Verdict.NOT_REPLICATED
