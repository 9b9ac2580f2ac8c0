"""The linear theory over arrays of parameters, the functions of :mod:`nucleation.api`."""

from functools import cache
from typing import Any

import numpy as np

from ..model.parameters import names
from ..model.quantities import ParameterError, declared
from ..model.units import magnitude
from ..types import Array, ComplexArray
from .critical import CriticalMode, critical_modes, stability_reason
from .fault import FaultParameters, takes_fault
from .spectrum import Systems, as_wavenumber
from .values import OF_THEORY, QUANTITIES, Values, labelled

WAVENUMBER = declared("wavenumber", "(-inf, inf) 1/m", symbol="k")


@takes_fault
def critical_length(**fault: Values) -> Any:
    """Critical nucleation length L_c of the linear theory.

    Parameters
    ----------
    **fault
        The parameters of :class:`~nucleation.api.fault.Fault`.

    Returns
    -------
    ndarray or DataArray
        ``L_c = 2 pi/k_c`` (m), broadcast shape; NaN where homogeneous sliding is stable
        (``nucleation.api.length_statuses`` has the reason). A
        DataArray if there is one among the parameters, else a pint quantity if there is one.

    Raises
    ------
    ParameterError
        If a parameter is missing, unknown or outside its range.

    Notes
    -----
    k_c is the largest wavenumber at which a root of Eq. (5) is marginal. Two half-spaces of one
    material have Eq. (6), of different materials Eq. (9), a thin layer on a rigid body Eq. (11).

    Examples
    --------
    >>> critical_length(
    ...     shear_modulus=30e9, poisson_ratio=0.25, normal_stress=[50e6, 100e6],
    ...     a=0.010, b=0.015, slip_distance=5e-6,
    ... )
    array([2.51327412, 1.25663706])
    """
    return _critical(fault_of(fault)).length


@takes_fault
def critical_mode(**fault: Values) -> CriticalMode:
    """Critical length, wavenumber and angular frequency of the linear theory.

    Parameters
    ----------
    **fault
        The parameters of :class:`~nucleation.api.fault.Fault`, with the `velocity`.

    Returns
    -------
    CriticalMode
        Each field of the kind and shape that :func:`critical_length` returns; NaN where
        homogeneous sliding is stable.

    Raises
    ------
    ParameterError
        If a parameter is missing, unknown or outside its range.

    Examples
    --------
    >>> mode = critical_mode(
    ...     shear_modulus=30e9, poisson_ratio=0.25, normal_stress=50e6,
    ...     a=0.010, b=0.015, slip_distance=5e-6, velocity=1e-6,
    ... )
    >>> round(float(mode.angular_frequency), 4)
    0.1414
    """
    return _critical(_with_velocity(fault_of(fault)))


@takes_fault
def spectrum(wavenumber: Values, **fault: Values) -> Any:
    """Growth rates of both modes of homogeneous sliding, the roots of Eq. (5).

    Parameters
    ----------
    wavenumber : array_like or DataArray
        k (1/m), not zero; broadcasts with the parameters.
    **fault
        The parameters of :class:`~nucleation.api.fault.Fault`, with the `velocity`.

    Returns
    -------
    ndarray or DataArray
        Lambda (1/s), complex, of perturbations ``exp(Lambda t - i k x)``; shape ``(2,)`` and the
        broadcast shape, the faster root first. The first dimension of a DataArray is ``root``.

    Raises
    ------
    ParameterError, ValueError
        If a parameter or the wavenumber is missing, unknown or outside its range.

    Examples
    --------
    >>> rates = spectrum(
    ...     2.0,
    ...     shear_modulus=30e9, poisson_ratio=0.25, normal_stress=50e6,
    ...     a=0.010, b=0.015, slip_distance=5e-6, velocity=1e-6,
    ... )
    >>> rates.shape, bool(rates[0].real > 0.0)
    ((2,), True)
    """

    own = _with_velocity(fault_of(fault))
    k = magnitude("wavenumber", wavenumber, WAVENUMBER)
    own.broadcast(wavenumber=k)

    def rates(
        systems: Systems,
        k: Array,
    ) -> ComplexArray:
        return systems.growth_rates(as_wavenumber(k))

    found = own.evaluate(rates, k, rows=2, dtype=complex)
    if labelled(found):
        found = found.rename(row="root")
    return named(found, "growth_rate", "1/s", "growth rate of the mode", own)


@takes_fault
def transfer_functions(wavenumber: Values, **fault: Values) -> tuple[Any, Any]:
    """Elastic transfer functions G1 and G2 of the pair of bodies.

    Parameters
    ----------
    wavenumber : array_like or DataArray
        k (1/m), not zero; broadcasts with the parameters.
    **fault
        The parameters of :class:`~nucleation.api.fault.Fault`; those of friction have no effect
        and are optional.

    Returns
    -------
    G1, G2 : ndarray or DataArray
        ``delta sigma_xy = -mu k G1 delta epsilon``, ``delta sigma_yy = i mu k G2 delta epsilon``
        with mu of the first body; dimensionless, broadcast shape (Eqs. 7, 10).

    Raises
    ------
    ParameterError, ValueError
        If a parameter or the wavenumber is missing, unknown or outside its range.

    Examples
    --------
    >>> shear, normal = transfer_functions(2.5, shear_modulus=30e9, poisson_ratio=0.25)
    >>> round(float(shear), 4), round(float(normal), 4)
    (0.6667, 0.0)
    """
    neutral = {"normal_stress": 1e6, "a": 0.01, "slip_distance": 1e-6, "friction": 0.0}
    if "zeta" not in fault and "b" not in fault:
        neutral["zeta"] = 0.01
    own = fault_of(neutral | fault)
    k = magnitude("wavenumber", wavenumber, WAVENUMBER)
    own.broadcast(wavenumber=k)

    def functions(
        systems: Systems,
        k: Array,
    ) -> tuple[Array, Array]:
        return systems.pair.transfer_functions(as_wavenumber(k))

    shear, normal = own.evaluate(functions, k, rows=2)
    return (
        named(shear, "G1", "1", "shear response", own),
        named(normal, "G2", "1", "normal response", own),
    )


def _critical(fault: FaultParameters) -> CriticalMode:
    length, k, omega = fault.evaluate(critical_modes, rows=3)
    mirrored = np.logical_not(fault.bodies_differ)
    omega = omega + (abs(omega) - omega) * mirrored  # keeps the dimensions' names
    return CriticalMode(
        length=named(length, "critical_length", "m", "critical nucleation length", fault),
        wavenumber=named(k, "critical_wavenumber", "1/m", "critical wavenumber", fault),
        angular_frequency=named(
            omega, "critical_frequency", "rad/s", "frequency of the critical mode", fault
        ),
    )


def reasons_of_stability(fault: FaultParameters) -> Any:
    """Why homogeneous sliding of stable faults is stable at every wavelength, broadcast shape."""

    def reasons(systems: Systems) -> list[list[str]]:
        return [[stability_reason(systems.at(np.array([i]))) for i in range(systems.a.size)]]

    return fault.evaluate(reasons, dtype=object)[0]


@cache
def aliases() -> dict[str, str]:
    """The parameters of a fault by the other names that simulations and studies use."""
    known = names()
    found: dict[str, str] = {}
    for name in QUANTITIES.keys() - set(OF_THEORY):
        full = known.full(name)
        others = {full, known.short(full), *known.others(full)}
        for alias in others - {name}:
            found[alias] = name
    return found


def without_aliases(parameters: dict[str, Any]) -> dict[str, Any]:
    """Keywords with the names of a fault in place of :func:`aliases`."""
    found: dict[str, Any] = {}
    for key, value in parameters.items():
        name = aliases().get(key, key)
        if name in found:
            raise ParameterError(f"{key} is not allowed beside {name}, which is the same")
        found[name] = value
    return found


def fault_of(parameters: dict[str, Any]) -> FaultParameters:
    """The fault with the given keywords; some of them may be :func:`aliases`."""
    return FaultParameters(**without_aliases(parameters))


def _with_velocity(fault: FaultParameters) -> FaultParameters:
    if fault.velocity is None:
        raise ParameterError("velocity (m/s) is missing: rates and frequencies depend on it")
    return fault


def named(
    values: Any,
    name: str,
    units: str,
    long_name: str,
    fault: FaultParameters,
) -> Any:
    """A result in the form of the fault's parameters.

    Parameters
    ----------
    values : ndarray or DataArray
        Plain numbers in SI units.
    name, units, long_name : str
        Of the result; only a DataArray has the names.
    fault : FaultParameters
        The fault; if one of its parameters was a pint quantity, so is the result.

    Returns
    -------
    DataArray, pint quantity or ndarray
        Same shape.
    """
    if labelled(values):
        return values.rename(name).assign_attrs(units=units, long_name=long_name)
    return values if fault.registry is None else fault.registry.Quantity(values, units)
