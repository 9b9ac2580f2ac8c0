"""The library's front: arrays of parameters against the theory for one fault at a time."""

import doctest
import inspect
import math
import signal
import sys

import asked
import numpy as np
import pint
import pytest
import xarray as xr
from numpy.testing import assert_allclose
from two_bodies import Body, Interface, critical_wavenumber

from nucleation import api
from nucleation.model.material import Material
from nucleation.model.quantities import ParameterError

ROCK = {"shear_modulus": 30e9, "poisson_ratio": 0.25, "normal_stress": 50e6}
FRICTION = {"a": 0.010, "b": 0.015, "slip_distance": 5e-6}
FAULT = ROCK | FRICTION
PAPER = {
    "shear_modulus": 3.1e9,
    "poisson_ratio": 1 / 3,
    "normal_stress": 1e6,
    "a": 0.0068,
    "zeta": 0.016,
    "slip_distance": 5e-7,
    "friction": 0.41,
    "second_shear_modulus": math.inf,
}


@pytest.mark.parametrize(
    ("heights", "sides"), [((0.3, 0.7), ("velocity",) * 2), ((0.3, 0.3), ("free", "clamped"))]
)
def test_layers_of_different_heights_and_far_sides(heights, sides):
    material = Material(30e9, 0.25)
    bodies = (Body(material, h, side) for h, side in zip(heights, sides, strict=True))
    expected = critical_wavenumber(*bodies, Interface(0.6, 0.010, 0.005, 5e-6, 2e-6, 50e6))
    layers = {"height": heights[0], "second_height": heights[1]}
    layers |= {"far_side": sides[0], "second_far_side": sides[1]}
    found = asked.critical_mode(**FAULT, **layers, friction=0.6, velocity=2e-6)
    assert found.length == pytest.approx(expected.length)
    assert found.wavenumber == pytest.approx(expected.wavenumber)
    assert found.angular_frequency == pytest.approx(expected.angular_frequency)


def test_traction_is_read_as_free():
    fault = api.Fault(**FAULT, height=0.3, far_side="traction", second_far_side="traction")
    assert fault.far_side == fault.second_far_side == "free"
    assert fault == api.Fault(**FAULT, height=0.3)


@pytest.mark.parametrize(
    "name",
    [
        "shear_modulus",
        "poisson_ratio",
        "normal_stress",
        "a",
        "b",
        "slip_distance",
        "friction",
        "height",
        "second_shear_modulus",
        "second_poisson_ratio",
        "second_height",
    ],
)
def test_every_parameter_broadcasts(name):
    """A column of any parameter against a row of heights or of a, each point as if alone."""
    base = FAULT | {
        "friction": 0.6,
        "height": 0.5,
        "second_shear_modulus": 60e9,
        "second_poisson_ratio": 0.2,
        "second_height": 2.0,
    }
    row = "a" if name == "height" else "height"
    column_values = np.array([1.0, 1.1]) * base[name]
    row_values = np.array([1.0, 0.8, 1.2]) * base[row]
    found = asked.critical_length(**base | {name: column_values[:, None], row: row_values})
    assert found.shape == (2, 3)
    for (i, j), value in np.ndenumerate(found):
        alone = asked.critical_length(**base | {name: column_values[i], row: row_values[j]})
        assert alone == pytest.approx(value, rel=1e-13)
    assert np.ptp(found, axis=0).max() > 0.0


def test_units_are_converted_and_results_carry_theirs():
    """One fault in SI units, as DataArrays with CF units and as pint quantities."""
    plain = asked.critical_length(**FAULT)
    row = xr.DataArray([50.0, 100.0], dims="s", attrs={"units": "MPa"})
    named = asked.critical_length(**FAULT | {"normal_stress": row})
    assert_allclose(named, [plain, plain / 2])
    assert named.attrs["units"] == "m"
    quantity = pint.UnitRegistry().Quantity
    given = {"normal_stress": quantity([50, 100], "MPa"), "slip_distance": quantity(5, "um")}
    found = asked.critical_length(**FAULT | given)
    assert found.check("[length]")
    assert_allclose(found.to("mm").magnitude, [1e3 * plain, 5e2 * plain])
    mode = asked.critical_mode(**FAULT | given, velocity=quantity(1, "mm/yr"))
    assert mode.angular_frequency.check("1/[time]")
    rates = asked.spectrum(quantity(2.0, "1/mm"), **FAULT, velocity=1e-6)
    assert_allclose(rates, asked.spectrum(2e3, **FAULT, velocity=1e-6))


def test_texts_have_units_as_on_the_command_line():
    texts = {"shear_modulus": "30GPa", "normal_stress": ["50 MPa", 50e6], "slip_distance": "5um"}
    assert_allclose(asked.critical_length(**FAULT | texts), asked.critical_length(**FAULT))
    assert api.Friction(law="product", slip_distance="0.5um") == api.Friction(
        law="product", slip_distance=5e-7
    )
    run = api.Run.sized(api.PAPER.replace(height="5 cm"), block_length="90 cm", n_x="100")
    assert (run.fault.height, run.block.length, run.block.n_x) == (0.05, 0.9, 100)
    with pytest.raises(ParameterError, match=r"block_length = '5 s' .*unit of time, but m"):
        api.Run.sized(api.PAPER, block_length="5 s")


def test_spectrum_has_a_marginal_mode_at_the_critical_wavenumber():
    mode = asked.critical_mode(**PAPER, velocity=1e-5, height=0.01)
    k = mode.wavenumber * np.array([0.9, 1.0, 1.1])
    rates = asked.spectrum(k, **PAPER, velocity=1e-5, height=0.01)
    assert rates.shape == (2, 3)
    assert abs(rates[0, 1].real) < 1e-9 * abs(rates[0, 1])
    assert rates[0, 0].real > 0.0 > rates[0, 2].real
    marginal = rates[np.argmin(abs(rates[:, 1].real)), 1]
    assert marginal.imag == pytest.approx(mode.angular_frequency)


def test_named_arrays_keep_their_names():
    height = xr.DataArray([0.01, 0.1], dims="height", coords={"height": [0.01, 0.1]})
    a = xr.DataArray([0.005, 0.006, 0.007], dims="a")
    length = asked.critical_length(**PAPER | {"a": a, "height": height})
    assert set(length.dims) == {"height", "a"} and length.attrs["units"] == "m"
    plain = asked.critical_length(**PAPER | {"a": a.values, "height": height.values[:, None]})
    assert_allclose(length.transpose("height", "a"), plain)
    k = xr.DataArray([3.0, 4.0], dims="k")
    rates = asked.spectrum(k, velocity=1e-5, **PAPER, height=height)
    assert set(rates.dims) == {"root", "k", "height"} and rates.attrs["units"] == "1/s"
    g1, _ = asked.transfer_functions(2.0, shear_modulus=1e9, poisson_ratio=0.2, height=height)
    assert g1.dims == ("height",)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"height": [[1.0], [np.nan]]}, r"height\[1, 0\] = nan m is not allowed"),
        ({"height": [1.0, 2.0], "a": [0.01] * 3}, r"don't broadcast: a \(3,\), height \(2,\)"),
        ({"a": True}, "a = True is not allowed"),
        ({"xyzzy": 1.0}, "unexpected keyword argument 'xyzzy'; known: shear_modulus, "),
        ({"height": np.ones(2), "a": xr.DataArray([0.01], dims="a")}, "named dimensions"),
    ],
)
def test_bad_parameters(changes, words):
    with pytest.raises(ParameterError, match=words):
        asked.critical_length(**FAULT | changes)


def test_missing_parameters():
    for function in (asked.critical_mode, lambda **fault: asked.spectrum(1.0, **fault)):
        with pytest.raises(ParameterError, match="velocity"):
            function(**FAULT)
    with pytest.raises(ValueError, match="wavenumber"):
        asked.spectrum(0.0, **FAULT, velocity=1.0)


@pytest.mark.parametrize("name", api.__all__)
def test_each_name_has_an_example(name):
    announced = getattr(api, name)
    names = vars(sys.modules[announced.__module__]) | {name: announced}
    own = doctest.DocTestParser().get_doctest(announced.__doc__, dict(names), name, None, None)
    assert own.examples and doctest.DocTestRunner().run(own).failed == 0


def test_example_of_the_module():
    assert inspect.signature(api.Fault).parameters["height"].default == math.inf  # for completion
    assert doctest.testmod(api) == (0, 3)  # failed, attempted
    with pytest.raises(AttributeError, match="no attribute 'simulations'"):
        api.simulations  # noqa: B018


SHORT = {"block_length": 0.9, "n_x": 16, "n_y": 2, "end_time": 0.02}


def test_an_interrupted_run_keeps_its_record(capsys):
    """Ctrl-C ends a run after its step; what follows is not interrupted."""
    signal.signal(signal.SIGINT, signal.default_int_handler)  # background shells ignore it
    parameters, steps = api.Run.sized(api.PAPER, **SHORT), []

    def interrupt(instant):
        steps.append(instant)
        if len(steps) == 5:
            signal.raise_signal(signal.SIGINT)

    record = api.simulate(parameters, progress=interrupt)
    assert record.attrs["status"].startswith("interrupted") and not record.attrs["completed"]
    assert record.sizes["step"] == 5
    whole = api.simulate(parameters, progress=True)
    assert whole.attrs["completed"] and "of the way" in capsys.readouterr().err
    assert_allclose(record["driving_force"], whole["driving_force"][:5], rtol=0.0)
    with pytest.raises(KeyboardInterrupt):
        signal.raise_signal(signal.SIGINT)
