"""Pictures in one call: of a run, of lengths over a parameter, of a spectrum, of a dataset."""

import os
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from ..analysis.extraction import extract
from ..analysis.film import film_dataset
from ..analysis.record import Record
from ..figures import laws, style
from ..model.quantities import ParameterError
from ..theory.arrays import critical_length, critical_mode, fault_of, spectrum
from ..theory.creep.lengths import stability_length
from ..theory.fault import QUANTITIES, takes_fault
from ..types import Array
from .beyond import animation
from .paper import figure_3, figure_s2

SHOWN_WAVENUMBERS = np.linspace(0.02, 2.0, 200)  # over k_c
MOST_PATCHES = 40  # L_s of more faults takes longer than one waits for a picture
WIDE = 10.0  # ratio of a parameter's values from which axes are logarithmic


@style.styled
def draw_theory(theory: xr.Dataset) -> Figure:
    """Draw ``critical_length`` and ``thin_limit_length`` (m) against ``height`` (m)."""
    figure, axes = style.column(6.4)
    figure_3.draw_theory(axes, theory)
    height, length = theory["height"].values, theory["critical_length"].values
    axes.set(xlabel="Height $H$ (m)", ylabel="Critical length $L_c$ (m)")
    axes.set(xlim=(0.0, height.max()), ylim=(0.0, 1.15 * length.max()))
    axes.legend(loc="lower right")
    return figure


@style.styled
def draw_lengths(table: xr.Dataset) -> Figure:
    """Draw ``length`` with ``_low`` and ``_high`` (m) against ``theory_length`` (m)."""
    figure, axes = style.column(7.4)
    for number, rows in enumerate(laws.groups(table, "study")):
        marker, colour = style.look(number)
        theory, look = rows["theory_length"].values, {"marker": marker, "color": colour}
        laws.draw(axes, theory, rows, "length", label=str(rows["study"].values[0]), **look)
    top = 1.08 * float(max(table["theory_length"].max(), table["length_high"].max()))
    axes.plot([0.0, top], [0.0, top], color=style.GUIDE, linewidth=0.9, zorder=0)
    axes.annotate("theory", (0.8 * top, 0.82 * top), color=style.GUIDE, rotation=45, ha="center")
    axes.set(xlabel="$L_c$ of the theory (m)", ylabel="$L_c$ of the simulation (m)")
    axes.set(xlim=(0.0, top), ylim=(0.0, top), aspect="equal")
    axes.legend(loc="upper left")
    return figure


@style.styled
def draw_patch(patch: xr.Dataset) -> Figure:
    """Draw ``oscillation_growth`` and ``_frequency`` (1/s) against ``patch_length`` (m)."""
    rate = patch["oscillation_growth"].values + 1j * patch["oscillation_frequency"].values
    marked = {"$L_s$": float(patch["stability_length"])}
    return _rates("Patch length $L$ (m)", patch["patch_length"].values, {"": rate}, marked)


def _rates(label: str, over: Array, modes: dict[str, Any], marked: dict[str, float]) -> Figure:
    """Growth and frequency of modes, by their names, with zero growth and a place marked."""
    figure = style.new_figure(style.SINGLE_COLUMN, 8.4 * style.CENTIMETRE)
    growth, frequency = figure.subplots(2, 1, sharex=True)
    for (name, rate), dashes in zip(modes.items(), ("-", "--"), strict=False):
        growth.plot(over, rate.real, dashes, color=style.THEORY, label=name)
        frequency.plot(over, rate.imag, dashes, color=style.THEORY)
    growth.axhline(0.0, color=style.GUIDE, linewidth=0.9)
    for name, place in marked.items():
        for axes in (growth, frequency):
            axes.axvline(place, color=style.GUIDE, linestyle=":")
        where = growth.get_xaxis_transform()
        growth.annotate(name, (place, 1.0), (3.0, -10.0), where, "offset points", color=style.GUIDE)
    growth.set_ylabel(r"Growth rate $\mathrm{Re}\,\Lambda$ (1/s)")
    frequency.set(xlabel=label, ylabel=r"Frequency $\mathrm{Im}\,\Lambda$ (1/s)")
    if len(modes) > 1:
        growth.legend()
    return figure


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
    modes = dict(zip(("faster mode", "slower mode"), rates, strict=True))
    return _rates("Wavenumber $k$ (1/m)", k, modes, {"$k_c$": float(critical)})


def film(record: xr.Dataset, path: str | os.PathLike[str]) -> None:
    """Write a film of a run, a GIF, to a path; an older file is replaced.

    `record` is that of :func:`nucleation.simulation.run.simulate`; the run is made once more for
    the stress in its bodies.
    """
    row = xr.Dataset(extract(record))
    animation.save(animation.frames(film_dataset(record, row), row), path)
