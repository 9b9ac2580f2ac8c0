"""The bridge between simulation and theory: growth of single modes on homogeneous sliding.

The time integration (:mod:`.sliding_modes`) gives both growth rates of a wavenumber; they have to
be the two roots of Eq. (5).
"""

import math

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from nucleation.datasets.variables import Variable, annotate
from nucleation.run.run import PAPER_RUN, Run
from nucleation.theory.critical import unstable_modes
from nucleation.theory.evaluation import single_system
from nucleation.types import ComplexArray

from .curves import CURVES
from .main_text import on_rigid_base
from .rows import SHARED
from .sliding_modes import measured_rates

HEIGHTS = (0.005, 0.02, 0.1, 0.5)  # m, of the paper's fault
MODES = (0.5, 0.6, 0.7, 0.8, 0.9, 0.97, 1.03, 1.1, 1.25, 1.5, 1.75, 2.0)  # k / k_c

MODES_OF_SLIDING = {
    "height": SHARED["height"],
    "mode_wavenumber": Variable("1/m", "wavenumber of the seeded mode", "k"),
    "measured_growth": Variable("1/s", "growth rate in the time integration", "Re Lambda"),
    "measured_frequency": Variable("1/s", "angular frequency in the time integration", "Im Lambda"),
    "theory_growth": Variable("1/s", "growth rate of the seeded mode, Eq. (5)", "Re Lambda"),
    "theory_frequency": Variable(
        "1/s", "angular frequency of the seeded mode, Eq. (5)", "Im Lambda"
    ),
    "disagreement": Variable("1", "difference of the complex rates over the theory's"),
    "critical_wavenumber": CURVES["critical_wavenumber"],
}


def by_direction(rates: ArrayLike) -> ComplexArray:
    """Rates in the order of falling frequency along the last axis."""
    values = np.asarray(rates, dtype=complex)
    order = np.argsort(-values.imag, axis=-1)
    return np.take_along_axis(values, order, axis=-1)


def _heights_for(run: Run) -> list[float]:
    """Heights (m) that have the ratios of :data:`HEIGHTS` to the L_c of a high block."""
    own, papers = (on_rigid_base(one.fault, math.inf).critical_length() for one in (run, PAPER_RUN))
    ratio = float(own / papers)
    return [float(f"{height * ratio:.3g}") for height in HEIGHTS]


def dispersion_dataset(
    run: Run, heights: ArrayLike = HEIGHTS, modes: ArrayLike = MODES
) -> xr.Dataset:
    """Rates by Eq. (5) and by the time integration on (height, mode, branch).

    Heights are in m, modes are wavenumbers over the critical one. The branch with the larger
    frequency travels along +x, the direction of sliding, and comes first.
    """
    heights = np.asarray(heights, dtype=float)
    modes = np.asarray(modes, dtype=float)
    critical = []
    measured = []
    theory = []
    for height in heights:
        block = single_system(on_rigid_base(run.fault, height))
        k_c = float(unstable_modes(block).wavenumber[0])
        seeded = k_c * modes
        critical.append(k_c)
        measured.append([measured_rates(run, height, k) for k in seeded])
        theory.append(block.growth_rates(seeded).T)
    on = ("height", "mode", "branch")
    columns: dict[str, object] = {
        "mode_wavenumber": (on[:2], np.outer(critical, modes)),
        "critical_wavenumber": ("height", critical),
    }
    for name, values in (("measured", measured), ("theory", theory)):
        rates = by_direction(values)
        columns[f"{name}_growth"] = (on, rates.real)
        columns[f"{name}_frequency"] = (on, rates.imag)
    found = xr.Dataset(columns, {"height": heights})
    found = found.assign(disagreement=disagreement(found))
    return annotate(found, MODES_OF_SLIDING)


def disagreement(dataset: xr.Dataset) -> xr.DataArray:
    """``|Lambda - Lambda_theory| / |Lambda_theory|`` of each mode and branch."""
    growth = dataset["theory_growth"]
    frequency = dataset["theory_frequency"]
    error = dataset["measured_growth"] - growth
    error_of_frequency = dataset["measured_frequency"] - frequency
    difference: xr.DataArray = xr.apply_ufunc(np.hypot, error, error_of_frequency)
    size: xr.DataArray = xr.apply_ufunc(np.hypot, growth, frequency)
    return difference / size


def dispersion_csv(dataset: xr.Dataset) -> str:
    """Measured and theoretical rates of every mode as comma-separated text."""
    columns = [
        "mode_wavenumber",
        "measured_growth",
        "measured_frequency",
        "theory_growth",
        "theory_frequency",
        "disagreement",
    ]
    ratio = dataset["mode_wavenumber"] / dataset["critical_wavenumber"]
    table = dataset[columns].assign(wavenumber_over_critical=ratio)
    frame = table.to_dataframe().reset_index()
    order = ["height", "wavenumber_over_critical", "branch", *columns]
    return frame[order].to_csv(index=False, float_format="%.8g")


def files(base: Run) -> dict[str, xr.Dataset | str]:
    """The files of the step ``dispersion``."""
    found = dispersion_dataset(base, _heights_for(base))
    return {".nc": found, ".csv": dispersion_csv(found)}
