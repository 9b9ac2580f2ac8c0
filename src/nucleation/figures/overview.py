"""Pictures in one call: of a run, of lengths over a parameter, of a spectrum; a film."""

import os
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from ..analysis.extraction import extract
from ..analysis.film import film_dataset
from ..analysis.record import Record
from ..figures import style
from ..model.quantities import ParameterError
from ..theory.arrays import critical_length, critical_mode, fault_of, spectrum
from ..theory.creep.lengths import stability_length
from ..theory.fault import QUANTITIES, takes_fault
from .beyond import animation
from .paper import figure_s2

SHOWN_WAVENUMBERS = np.linspace(0.02, 2.0, 200)  # over k_c
MOST_PATCHES = 40  # L_s of more faults takes longer than one waits for a picture
WIDE = 10.0  # ratio of a parameter's values from which axes are logarithmic


def plot_run(record: xr.Dataset) -> Figure:
    """Picture of a run: shear stress in space and time, force, onset and patch length.

    `record` is that of :func:`nucleation.simulation.run.simulate`, with slip and stresses.
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
        The parameter of which `fault` has several values, such as ``"height"``. L_s is computed
        for some of them if they are many.
    **fault
        The parameters of :class:`~nucleation.theory.fault.Fault`.

    Raises
    ------
    ParameterError
        If a parameter is wrong, or `over` is not the one that has several values.
    """
    if over not in QUANTITIES or over not in fault:
        raise ParameterError(f"over = {over!r} is not allowed: it must be a parameter given")
    values = np.asarray(getattr(fault_of(fault), over))
    length = np.asarray(critical_length(**fault))
    if values.ndim != 1 or length.shape != values.shape:
        raise ParameterError(f"{over} needs several values, in one dimension, and nothing else may")
    some = np.unique(np.linspace(0, values.size - 1, MOST_PATCHES).astype(int))
    patch = np.asarray(stability_length(**fault | {over: values[some]}))
    figure, axes = style.column(6.6)
    axes.plot(values, length, color=style.THEORY, label="$L_c$, homogeneous sliding")
    axes.plot(values[some], patch, color=style.GREEN, linestyle="--", label="$L_s$, creeping patch")
    if values.min() > 0.0 and values.max() >= WIDE * values.min():
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
        The parameters of :class:`~nucleation.theory.fault.Fault`, of one fault that is unstable.

    Raises
    ------
    ParameterError
        If a parameter is wrong, there are several faults, or sliding is stable.
    """
    mode = critical_mode(**fault)
    critical = np.asarray(getattr(mode.wavenumber, "magnitude", mode.wavenumber))
    if critical.size != 1 or not np.isfinite(critical).all():
        raise ParameterError("a spectrum is drawn of one fault that has a critical length")
    k = SHOWN_WAVENUMBERS * float(critical)
    rates = spectrum(k, **fault)
    rates = np.asarray(getattr(rates, "magnitude", rates))
    figure = style.new_figure(style.SINGLE_COLUMN, 8.4 * style.CENTIMETRE)
    growth, frequency = figure.subplots(2, 1, sharex=True)
    for name, rate, dashes in zip(("faster mode", "slower mode"), rates, ("-", "--"), strict=True):
        growth.plot(k, rate.real, dashes, color=style.THEORY, label=name)
        frequency.plot(k, rate.imag, dashes, color=style.THEORY)
    growth.axhline(0.0, color=style.GUIDE, linewidth=0.9)
    for axes in (growth, frequency):
        axes.axvline(float(critical), color=style.GUIDE, linestyle=":")
    place: Any = ((float(critical), 1.0), (3.0, -10.0), growth.get_xaxis_transform())
    growth.annotate("$k_c$", *place, "offset points", color=style.GUIDE)
    growth.set_ylabel(r"Growth rate $\mathrm{Re}\,\Lambda$ (1/s)")
    growth.legend()
    frequency.set(xlabel="Wavenumber $k$ (1/m)", ylabel=r"Frequency $\mathrm{Im}\,\Lambda$ (1/s)")
    return figure


def film(record: xr.Dataset, path: str | os.PathLike[str]) -> None:
    """Write a film of a run, a GIF, to a path; an older file is replaced.

    `record` is that of :func:`nucleation.simulation.run.simulate`; the run is made once more for
    the stress in its bodies.
    """
    row = xr.Dataset(extract(record))
    animation.save(animation.frames(film_dataset(record, row), row), path)
