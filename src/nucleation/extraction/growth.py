"""The length at which the creep patch of a simulation turns linearly unstable, free of its noise.

Growth of the frozen patch (:mod:`nucleation.extraction.frozen`) begins where the first of its modes
stops decaying; that mode oscillates there (:mod:`nucleation.theory.creep.lengths`). Each instant of
a run needs the spectrum of a dense matrix, and a run has some hundred of them. So a few instants,
spaced evenly in patch length, give the rough crossing by the fastest growing mode. A line through
the oscillating mode at the instants around it gives the length.
"""

from collections.abc import Iterable

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ..datasets.variables import Variable, annotate
from ..simulation.recorded import RECORDED
from ..theory.creep.linearised import FrozenPatch
from ..types import Array, ComplexArray
from .definitions import ExtractionSettings
from .frozen import Freezer
from .record import Record

FEWEST_NODES = 8  # a shorter patch is not resolved
SCANNED = 40  # instants that give the rough crossing
NEAR = 60  # instants around it, at most, to which the line is fitted
AROUND = 0.08  # their range of lengths, to either side, over the crossing's length
REFITS = 2  # the second is about the crossing of the first
FEWEST_NEAR = 4  # instants for a line

FITTED = {
    "stability_length": Variable("m", "patch length where growth begins", "L_s"),
    "stability_length_low": Variable("m", "L_s less the scatter as the front hops", "L_s"),
    "stability_length_high": Variable("m", "L_s with the scatter as the front hops", "L_s"),
    "stability_length_error": Variable("m", "standard error of L_s", "L_s"),
    "stability_frequency": Variable("1/s", "angular frequency where growth begins", "omega"),
}
"""Variables of the patch where its growth begins."""

FOLLOWED = {
    "x": RECORDED["x"],
    "instant_time": Variable("s", "time at which the patch is frozen", "t"),
    "patch_length": Variable("m", "length of the creep patch", "L(t)"),
    "growth_rate": Variable("1/s", "fastest growth of the frozen patch", "max Re Lambda"),
    "growth_frequency": Variable("1/s", "angular frequency of that mode", "|Im Lambda|"),
    "oscillation_growth": Variable("1/s", "growth of the patch's oscillating mode", "Re Lambda"),
    "oscillation_frequency": Variable("1/s", "angular frequency of that mode", "Im Lambda"),
    **FITTED,
    "mode_real": Variable("1", "slip in that mode where growth begins, real part"),
    "mode_imaginary": Variable("1", "slip in that mode where growth begins, imaginary part"),
}


def follow_patch(
    simulation: xr.Dataset,
    settings: ExtractionSettings,
) -> xr.Dataset:
    """Growth of the frozen patch along a run up to its onset, and the length where it begins.

    Parameters
    ----------
    simulation : Dataset
        Record of a run.
    settings : ExtractionSettings
        Definitions of the onset and of the patch's length.

    Returns
    -------
    Dataset
        The variables :data:`FOLLOWED`: patches on ``instant``, the mode where growth begins on
        ``x``. NaN where no mode oscillates, and where growth does not begin.
    """
    spectra = _Spectra(Record(simulation, settings))
    frames = np.flatnonzero(spectra.length >= FEWEST_NODES * spectra.grid.dx)
    scanned = evenly(frames, spectra.length, SCANNED)
    fastest, _ = spectra.rates(scanned)
    crossing = rough_crossing(spectra.length[scanned], fastest.real)
    fit = dict.fromkeys(FITTED, float("nan"))
    near = frames
    for _ in range(REFITS):
        if np.isfinite(crossing):
            near = frames[np.abs(spectra.length[frames] / crossing - 1.0) < AROUND]
            near = evenly(near, spectra.length, NEAR)
            _, oscillating = spectra.rates(near)
            fit = fitted_crossing(spectra.length[near], oscillating)
            crossing = fit["stability_length"]
    mode = np.zeros(spectra.grid.n_x + 1, dtype=complex)
    if np.isfinite(crossing):
        distance = np.abs(spectra.length[near] - crossing)
        patch, rate = spectra.patch(near[distance.argmin()])
        mode[patch.nodes], _ = patch.mode(rate)
    return spectra.dataset(fit, mode)


class _Spectra(Freezer):
    """The frozen patches of a recorded run up to its onset, their eigenvalues computed once."""

    def __init__(self, record: Record) -> None:
        super().__init__(record.run, record.threshold)
        names = ("slip_rate", "state", "sigma_yy")
        self._fields = [record.simulation[name].values[record.creep] for name in names]
        self.time = record.time[record.creep]
        self.length = record.lengths[record.creep]
        self._known: dict[int, tuple[complex, complex]] = {}  # fastest and oscillating

    def patch(self, frame: int) -> tuple[FrozenPatch, complex]:
        """The frozen patch at a frame, and its oscillating mode."""
        rate, state, stress = (field[frame] for field in self._fields)
        patch = self.frozen(rate, state, -stress * self.grid.nodal_lengths)
        return patch, self.oscillating(patch, rate)

    def rates(self, frames: Iterable[int]) -> tuple[ComplexArray, ComplexArray]:
        """Eigenvalues (1/s) of the fastest growing mode and of the oscillating one, or NaN."""
        rates = [self._rates(frame) for frame in frames]
        fastest, oscillating = np.array(rates, dtype=complex).reshape(-1, 2).T
        return fastest, oscillating

    def _rates(self, frame: int) -> tuple[complex, complex]:
        if frame not in self._known:
            patch, pair = self.patch(frame)
            fastest = complex(np.nan, np.nan)
            if patch.nodes.size:
                fastest = patch.eigenvalues[0]
            self._known[frame] = (fastest, pair)
        return self._known[frame]

    def dataset(
        self,
        fit: dict[str, float],
        mode: ComplexArray,
    ) -> xr.Dataset:
        """The dataset of :func:`follow_patch`.

        Parameters
        ----------
        fit : dict
            Values of :data:`FITTED`, by name.
        mode : ndarray
            Slip in the mode where growth begins, (n_x + 1,).

        Returns
        -------
        Dataset
            The variables :data:`FOLLOWED` at all frames with known eigenvalues.
        """
        frames = sorted(self._known)
        fastest, oscillating = self.rates(frames)
        found = xr.Dataset(
            {
                "instant_time": ("instant", self.time[frames]),
                "patch_length": ("instant", self.length[frames]),
                "growth_rate": ("instant", fastest.real),
                "growth_frequency": ("instant", np.abs(fastest.imag)),
                "oscillation_growth": ("instant", oscillating.real),
                "oscillation_frequency": ("instant", oscillating.imag),
                **fit,
                "mode_real": ("x", mode.real),
                "mode_imaginary": ("x", mode.imag),
            },
            coords={"x": self.grid.x},
            attrs={"parameters": self.run.to_json()},
        )
        return annotate(found, FOLLOWED)


def evenly(
    frames: NDArray[np.intp],
    length: Array,
    number: int,
) -> NDArray[np.intp]:
    """Some of the frames, spaced evenly in patch length.

    Parameters
    ----------
    frames : ndarray
        Indices of frames, rising.
    length : ndarray
        Patch length (m) at each frame of the run.
    number : int
        At most as many are chosen.

    Returns
    -------
    ndarray
        Indices of frames.
    """
    if frames.size <= number:
        return frames
    lengths = length[frames]
    wanted = np.linspace(lengths[0], lengths[-1], number)
    nearest = np.searchsorted(lengths, wanted)
    nearest = nearest.clip(0, frames.size - 1)
    return frames[np.unique(nearest)]


def rough_crossing(
    length: Array,
    growth: Array,
) -> float:
    """Patch length that best divides decay from growth.

    The range of lengths with the wrong sign is the least possible: on a coarse mesh the growth rate
    fluctuates as the front moves from node to node.

    Parameters
    ----------
    length : ndarray
        Patch lengths (m), rising, (n,).
    growth : ndarray
        Growth rates (1/s), or NaN, (n,).

    Returns
    -------
    float
        The length (m), NaN without growth or without decay.
    """
    usable = np.isfinite(growth)
    length, growth = length[usable], growth[usable]
    if length.size < FEWEST_NEAR or growth.max() <= 0.0 or growth.min() > 0.0:
        return float("nan")
    ranges = np.gradient(length) * np.sign(growth)
    wrong = np.append(0.0, np.cumsum(ranges))  # less the same constant for each division
    at = int(wrong.argmin())
    if at == 0:
        return float("nan")
    return float(length[min(at, length.size - 1)])


def fitted_crossing(
    length: Array,
    growth: ComplexArray,
) -> dict[str, float]:
    """Where a line through eigenvalues over patch length crosses zero growth.

    The front advances by one node at a time, and growth varies within each hop. The scatter about
    the line over its slope gives the range of lengths at which growth may begin.

    Parameters
    ----------
    length : ndarray
        Patch lengths (m), (n,).
    growth : ndarray
        Eigenvalues (1/s), or NaN, (n,).

    Returns
    -------
    dict
        Values of :data:`FITTED`, by name; NaN if the line does not cross zero within the lengths.
    """
    none = dict.fromkeys(FITTED, float("nan"))
    usable = np.isfinite(growth)
    length, growth = length[usable], growth[usable]
    if length.size < FEWEST_NEAR:
        return none
    centre = length.mean()
    offset = length - centre
    slope, level = np.polyfit(offset, growth.real, 1)
    if slope <= 0.0:
        return none
    crossing = centre - level / slope
    if not length.min() <= crossing <= length.max():
        return none
    turn, frequency = np.polyfit(offset, growth.imag, 1)
    misfit = growth.real - level - slope * offset
    scatter = np.std(misfit, ddof=2) / slope
    lever = np.hypot(1.0, (crossing - centre) / length.std())
    return {
        "stability_length": float(crossing),
        "stability_length_low": float(crossing - scatter),
        "stability_length_high": float(crossing + scatter),
        "stability_length_error": float(scatter * lever / np.sqrt(length.size)),
        "stability_frequency": float(frequency + turn * (crossing - centre)),
    }
