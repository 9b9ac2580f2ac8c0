"""Pictures in one call: of a run, of lengths over a parameter, of a spectrum; a film."""

import os
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from replication.figures.beyond import animation
from replication.figures.film import film_dataset
from replication.figures.paper import figure_s2

from ..extraction.extraction import extract
from ..extraction.record import Record
from ..model.quantities import ParameterError
from ..theory.arrays import critical_length, critical_mode, fault_of, spectrum
from ..theory.creep.lengths import stability_length
from ..theory.fault import QUANTITIES, takes_fault
from ..types import Array
from . import style

_WAVENUMBERS = np.linspace(0.02, 2.0, 200)  # over k_c
_MOST_PATCHES = 40  # more values of L_s take too long for a picture
_WIDE = 10.0  # ratio of a parameter's values above which axes are logarithmic


def plot_run(record: xr.Dataset) -> Figure:
    """Picture of a run: shear stress in space and time, force, onset and patch length.

    `record` comes from :func:`nucleation.simulation.run.simulate`, with slip and stresses.

    Examples
    --------
    >>> from nucleation.api import Geometry, Mesh, Parameters, Stepping, simulate
    >>> parameters = Parameters(
    ...     geometry=Geometry(height=0.005, length=0.9),
    ...     mesh=Mesh(n_x=16, n_y=2),
    ...     stepping=Stepping(end_time=0.02),
    ... )
    >>> figure = plot_run(simulate(parameters))
    >>> len(figure.axes)
    5
    """
    Record(record).require("slip", "shear_stress")
    return figure_s2.draw(record, xr.Dataset(extract(record)))


@takes_fault
@style.styled
def plot_length(over: str, **fault: Any) -> Figure:
    """Picture of L_c and L_s over one parameter of a fault.

    Parameters
    ----------
    over : str
        The parameter with several values in `fault`, such as ``"height"``. If there are many
        values, L_s is computed for some of them.
    **fault
        The parameters of :class:`~nucleation.api.fault.Fault`.

    Returns
    -------
    Figure
        Lengths in m.

    Raises
    ------
    ParameterError
        If a parameter is wrong, or another parameter than `over` has several values.

    Examples
    --------
    >>> figure = plot_length(
    ...     "normal_stress", shear_modulus=30e9, poisson_ratio=0.25,
    ...     normal_stress=[50e6, 100e6], a=0.010, b=0.015, slip_distance=5e-6,
    ... )
    >>> len(figure.axes)
    1
    """
    if over not in QUANTITIES or over not in fault:
        raise ParameterError(f"over = {over!r} is not allowed: it must be a parameter given")
    values = np.asarray(getattr(fault_of(fault), over))
    length = np.asarray(critical_length(**fault))
    if values.ndim != 1 or length.shape != values.shape:
        raise ParameterError(f"{over} needs several values, in one dimension, and nothing else may")
    some = np.unique(np.linspace(0, values.size - 1, _MOST_PATCHES).astype(int))
    patch = np.asarray(stability_length(**fault | {over: values[some]}))
    figure, axes = style.column(6.6)
    axes.plot(
        values,
        length,
        color=style.THEORY,
        label="$L_c$, homogeneous sliding",
    )
    axes.plot(
        values[some],
        patch,
        color=style.GREEN,
        linestyle="--",
        label="$L_s$, creeping patch",
    )
    if values.min() > 0.0 and values.max() >= _WIDE * values.min():
        axes.set(xscale="log", yscale="log")
    entry = QUANTITIES[over]
    label = over if len(over) == 1 else over.replace("_", " ").capitalize()
    axes.set_xlabel(label if entry.unit == "1" else f"{label} ({entry.unit})")
    axes.set_ylabel("Nucleation length (m)")
    axes.legend()
    return figure


@takes_fault
@style.styled
def plot_spectrum(**fault: Any) -> Figure:
    """Picture of both modes' growth rate and frequency over the wavenumber; needs `velocity`.

    Parameters
    ----------
    **fault
        The parameters of :class:`~nucleation.api.fault.Fault`, of a single unstable fault.

    Returns
    -------
    Figure
        Rates in 1/s over the wavenumber in 1/m.

    Raises
    ------
    ParameterError
        If a parameter is wrong, there are several faults, or sliding is stable.

    Examples
    --------
    >>> figure = plot_spectrum(
    ...     shear_modulus=30e9, poisson_ratio=0.25, normal_stress=50e6,
    ...     a=0.010, b=0.015, slip_distance=5e-6, velocity=1e-6,
    ... )
    >>> len(figure.axes)
    2
    """
    wavenumber = _magnitude(critical_mode(**fault).wavenumber)
    if wavenumber.size != 1 or not np.isfinite(wavenumber).all():
        raise ParameterError("a spectrum is drawn of one fault that has a critical length")
    critical = float(wavenumber)
    k = _WAVENUMBERS * critical
    faster, slower = _magnitude(spectrum(k, **fault))
    figure = style.new_figure(style.SINGLE_COLUMN, 8.4 * style.CENTIMETRE)
    growth, frequency = figure.subplots(2, 1, sharex=True)
    for name, rate, dashes in (("faster mode", faster, "-"), ("slower mode", slower, "--")):
        growth.plot(k, rate.real, dashes, color=style.THEORY, label=name)
        frequency.plot(k, rate.imag, dashes, color=style.THEORY)
    growth.axhline(0.0, color=style.GUIDE, linewidth=0.9)
    for axes in (growth, frequency):
        axes.axvline(critical, color=style.GUIDE, linestyle=":")
    top = growth.get_xaxis_transform()
    look: style.Options = {"textcoords": "offset points", "color": style.GUIDE}
    growth.annotate("$k_c$", (critical, 1.0), (3.0, -10.0), top, **look)
    growth.set_ylabel(r"Growth rate $\mathrm{Re}\,\Lambda$ (1/s)")
    growth.legend()
    frequency.set(xlabel="Wavenumber $k$ (1/m)", ylabel=r"Frequency $\mathrm{Im}\,\Lambda$ (1/s)")
    return figure


def _magnitude(value: Any) -> Array:
    """An array, without the unit that pint has given it."""
    return np.asarray(getattr(value, "magnitude", value))


def film(record: xr.Dataset, path: str | os.PathLike[str]) -> None:
    """Write a film of a run as a GIF.

    The run is made again, for the stress in its bodies.

    Parameters
    ----------
    record : Dataset
        From :func:`nucleation.simulation.run.simulate`.
    path : path
        The file; an older one is replaced.

    Examples
    --------
    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> from nucleation.api import Geometry, Mesh, Parameters, Stepping, simulate
    >>> parameters = Parameters(
    ...     geometry=Geometry(height=0.005, length=0.9),
    ...     mesh=Mesh(n_x=16, n_y=2),
    ...     stepping=Stepping(end_time=0.02),
    ... )
    >>> with TemporaryDirectory() as folder:
    ...     path = Path(folder) / "run.gif"
    ...     film(simulate(parameters), path)
    ...     path.exists()
    True
    """
    row = xr.Dataset(extract(record))
    animation.save(animation.frames(film_dataset(record, row), row), path)
