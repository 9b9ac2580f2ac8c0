"""The linear theory over arrays of parameters, as :mod:`nucleation.api` offers it."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from ..model.quantities import ParameterError
from .critical import NoInstability, critical_wavenumber
from .fault import Fault, Values
from .spectrum import growth_rates
from .transfer import transfer_functions as _transfer_functions


class CriticalMode(NamedTuple):
    """The marginally stable mode with the largest wavenumber.

    Attributes
    ----------
    length : ndarray or DataArray
        Critical nucleation length ``L_c = 2 pi/k_c`` (m).
    wavenumber : ndarray or DataArray
        k_c (1/m).
    angular_frequency : ndarray or DataArray
        omega (rad/s) of ``exp(i omega t - i k_c x)``: along +x if positive. Where the bodies are
        mirror images both signs are marginal, and the positive one is given.
    """

    length: Any
    wavenumber: Any
    angular_frequency: Any


def critical_length(**fault: Values) -> Any:
    """Critical nucleation length L_c of the linear theory.

    Parameters
    ----------
    **fault
        The parameters of :class:`~nucleation.theory.fault.Fault`.

    Returns
    -------
    ndarray or DataArray
        ``L_c = 2 pi/k_c`` (m), broadcast shape; NaN where homogeneous sliding is stable.

    Raises
    ------
    ParameterError
        If a parameter is missing, unknown or outside its range.

    Notes
    -----
    k_c is the largest wavenumber at which a root of Eq. (5) is marginal. Two half-spaces of one
    material have Eq. (6), of different materials Eq. (9), a thin layer on a rigid body Eq. (11).
    """
    return _critical(_fault(fault)).length


def critical_mode(**fault: Values) -> CriticalMode:
    """Critical length, wavenumber and angular frequency; needs `velocity`.

    Parameters
    ----------
    **fault
        The parameters of :class:`~nucleation.theory.fault.Fault`.

    Returns
    -------
    CriticalMode
        NaN where homogeneous sliding is stable.

    Raises
    ------
    ParameterError
        If a parameter is missing, unknown or outside its range.
    """
    return _critical(_with_velocity(_fault(fault)))


def spectrum(wavenumber: Values, **fault: Values) -> Any:
    """Growth rates of both modes of homogeneous sliding, the roots of Eq. (5); needs `velocity`.

    Parameters
    ----------
    wavenumber : array_like or DataArray
        k (1/m), not zero; broadcasts with the parameters.
    **fault
        The parameters of :class:`~nucleation.theory.fault.Fault`.

    Returns
    -------
    ndarray or DataArray
        Lambda (1/s), complex, of perturbations ``exp(Lambda t - i k x)``; shape ``(2,)`` and the
        broadcast shape, the faster root first. The first dimension of a DataArray is ``root``.

    Raises
    ------
    ParameterError
        If a parameter is missing, unknown or outside its range.
    ValueError
        If a wavenumber is zero or not finite.
    """

    def rates(upper: Any, lower: Any, interface: Any, k: Any) -> Any:
        return growth_rates(k, upper, lower, interface)

    found = _with_velocity(_fault(fault)).evaluate(rates, wavenumber, rows=2, dtype=complex)
    if isinstance(found, xr.DataArray):
        return _named(found.rename(row="root"), "growth_rate", "1/s", "growth rate of the mode")
    return found


def transfer_functions(wavenumber: Values, **fault: Values) -> tuple[Any, Any]:
    """Elastic transfer functions G1 and G2 of the pair of bodies.

    Parameters
    ----------
    wavenumber : array_like or DataArray
        k (1/m), not zero; broadcasts with the parameters.
    **fault
        The parameters of :class:`~nucleation.theory.fault.Fault`; those of friction do not matter
        and may be left out.

    Returns
    -------
    G1, G2 : ndarray or DataArray
        ``delta sigma_xy = -mu k G1 delta epsilon``, ``delta sigma_yy = i mu k G2 delta epsilon``
        with mu of the first body; dimensionless, broadcast shape (Eqs. 7, 10).

    Raises
    ------
    ParameterError
        If a parameter is missing, unknown or outside its range.
    ValueError
        If a wavenumber is zero or not finite.
    """
    neutral = {"normal_stress": 1.0, "a": 1.0, "slip_distance": 1.0, "friction": 0.0}
    if fault.keys().isdisjoint({"zeta", "b"}):
        neutral["zeta"] = 1.0

    def functions(upper: Any, lower: Any, _: Any, k: Any) -> Any:
        return _transfer_functions(k, upper, lower)

    g1, g2 = _fault(neutral | fault).evaluate(functions, wavenumber, rows=2)
    return _named(g1, "G1", "1", "shear response"), _named(g2, "G2", "1", "normal response")


def _critical(fault: Fault) -> CriticalMode:
    def point(upper: Any, lower: Any, interface: Any) -> Any:
        try:
            mode = critical_wavenumber(upper, lower, interface)
        except NoInstability:
            return np.full(3, np.nan)
        return mode.length, mode.wavenumber, mode.angular_frequency

    length, wavenumber, frequency = fault.evaluate(point, rows=3)
    frequency = xr.where(fault.bodies_differ, frequency, abs(frequency))
    return CriticalMode(
        _named(length, "critical_length", "m", "critical nucleation length"),
        _named(wavenumber, "critical_wavenumber", "1/m", "critical wavenumber"),
        _named(frequency, "critical_frequency", "rad/s", "angular frequency of the critical mode"),
    )


def _fault(parameters: dict[str, Any]) -> Fault:
    try:
        return Fault(**parameters)
    except TypeError as error:  # a keyword that is missing or unknown
        raise ParameterError(str(error).replace("Fault.__init__()", "the fault")) from None


def _with_velocity(fault: Fault) -> Fault:
    if fault.velocity is None:
        raise ParameterError("velocity (m/s) is missing: rates and frequencies depend on it")
    return fault


def _named(values: Any, name: str, units: str, long_name: str) -> Any:
    """A DataArray with name and unit; an array as it is."""
    if not isinstance(values, xr.DataArray):
        return values
    return values.rename(name).assign_attrs(units=units, long_name=long_name)
