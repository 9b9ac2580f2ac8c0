"""The length at which the creep patch of a simulation turns linearly unstable, free of its noise.

Growth of the frozen patch (:mod:`nucleation.patch.frozen`) begins where the first of its modes
stops decaying, which oscillates there (:mod:`nucleation.theory.creep.lengths`). Each instant of a
run needs the spectrum of a dense matrix, and a run has some hundred of them: a few, spaced evenly
in patch length, find the crossing by the fastest growing mode, and a line through the oscillating
mode at the instants around it gives its length.
"""

from collections.abc import Iterable

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ..analysis.definitions import ExtractionSettings
from ..analysis.record import Record
from ..datasets.variables import Variable, annotate
from ..simulation.recorded import RECORDED
from ..types import Array, ComplexArray
from .frozen import Frames

FEWEST_NODES = 8  # a shorter patch is not resolved
SCANNED = 40  # instants that find the crossing,
NEAR = 60  # and those around it, at most, through which the line is laid:
AROUND = 0.08  # within this part of the crossing's length
REFITS = 2  # the second about the first one's crossing
FEWEST_NEAR = 4  # instants for a line

FITTED = {
    "stability_length": Variable("m", "patch length where growth begins", "L_s"),
    "stability_length_low": Variable("m", "L_s less the scatter as the front hops", "L_s"),
    "stability_length_high": Variable("m", "L_s with the scatter as the front hops", "L_s"),
    "stability_length_error": Variable("m", "standard error of L_s", "L_s"),
    "stability_frequency": Variable("1/s", "angular frequency where growth begins", "omega"),
}
"""What is read from a patch where its growth begins."""

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


def follow_patch(simulation: xr.Dataset, settings: ExtractionSettings) -> xr.Dataset:
    """Growth of the frozen patch along a run up to its onset, and the length where it begins.

    The dataset has :data:`FOLLOWED`: patches on ``instant``, the mode where growth begins on ``x``.
    NaN where no mode oscillates, and where growth does not begin.
    """
    record = _Creep(Record(simulation, settings))
    frames = np.flatnonzero(record.length >= FEWEST_NODES * record.grid.dx)
    scanned = evenly(frames, record.length, SCANNED)
    crossing = rough_crossing(record.length[scanned], record.fastest(scanned).real)
    fit = dict.fromkeys(FITTED, float("nan"))
    mode = np.zeros(record.grid.n_x + 1, dtype=complex)
    for _ in range(REFITS):
        if np.isfinite(crossing):
            near = frames[np.abs(record.length[frames] / crossing - 1.0) < AROUND]
            near = evenly(near, record.length, NEAR)
            fit = fitted_crossing(record.length[near], record.growth(near))
            crossing = fit["stability_length"]
    if np.isfinite(fit["stability_length"]):
        at = near[np.abs(record.length[near] - fit["stability_length"]).argmin()]
        patch, _ = record.patch(at)
        mode[patch.nodes], _ = patch.mode(record.growth([at])[0])
    found = record.dataset(fit, mode)
    return found.assign_attrs(parameters=simulation.attrs["parameters"])


class _Creep(Frames):
    """The frames of a run whose spectra are known once asked for."""

    def __init__(self, record: Record) -> None:
        super().__init__(record)
        self._known: dict[int, tuple[complex, complex]] = {}  # fastest and oscillating

    def fastest(self, frames: Iterable[int]) -> ComplexArray:
        """Eigenvalues (1/s) of the fastest growing mode at some frames, or NaN."""
        return np.array([self._rates(i)[0] for i in frames], dtype=complex)

    def growth(self, frames: Iterable[int]) -> ComplexArray:
        """Eigenvalues (1/s) of the fastest growing oscillating mode at some frames, or NaN."""
        return np.array([self._rates(i)[1] for i in frames], dtype=complex)

    def _rates(self, frame: int) -> tuple[complex, complex]:
        if frame not in self._known:
            patch, pair = self.patch(frame)
            fastest = patch.eigenvalues[0] if patch.nodes.size else complex(np.nan, np.nan)
            self._known[frame] = (fastest, pair)
        return self._known[frame]

    def dataset(self, fit: dict[str, float], mode: ComplexArray) -> xr.Dataset:
        """What :func:`follow_patch` returns."""
        frames = sorted(self._known)
        fastest, pairs = np.array([self._known[i] for i in frames]).reshape(-1, 2).T
        columns = {
            "instant_time": self.time[frames],
            "patch_length": self.length[frames],
            "growth_rate": fastest.real,
            "growth_frequency": np.abs(fastest.imag),
            "oscillation_growth": pairs.real,
            "oscillation_frequency": pairs.imag,
        }
        found = xr.Dataset(
            {
                **{name: ("instant", values) for name, values in columns.items()},
                **fit,
                "mode_real": ("x", mode.real),
                "mode_imaginary": ("x", mode.imag),
            },
            coords={"x": self.grid.x},
            attrs={"parameters": self.parameters.to_json()},
        )
        return annotate(found, FOLLOWED)


def evenly(frames: NDArray[np.intp], length: Array, number: int) -> NDArray[np.intp]:
    """At most `number` of some frames, spaced evenly in patch length (m)."""
    if frames.size <= number:
        return frames
    wanted = np.linspace(length[frames[0]], length[frames[-1]], number)
    return frames[np.unique(np.searchsorted(length[frames], wanted).clip(0, frames.size - 1))]


def rough_crossing(length: Array, growth: Array) -> float:
    """Patch length (m) that best divides decay from growth, NaN without either.

    The range of lengths on the wrong side of it is the least possible: on a coarse mesh the
    front's hops take growth to and fro.
    """
    usable = np.isfinite(growth)
    length, growth = length[usable], growth[usable]
    if length.size < FEWEST_NEAR or growth.max() <= 0.0 or growth.min() > 0.0:
        return float("nan")
    ranges = np.gradient(length) * np.sign(growth)
    wrong = np.append(0.0, np.cumsum(ranges))  # less the same constant for each division
    at = int(wrong.argmin())
    return float(length[min(at, length.size - 1)]) if at else float("nan")


def fitted_crossing(length: Array, growth: ComplexArray) -> dict[str, float]:
    """Where a line through eigenvalues (1/s) over patch length (m) crosses zero growth.

    The front advances by one node at a time, and growth varies within each hop: the scatter about
    the line over its slope gives the range of lengths at which growth may begin.
    """
    usable = np.isfinite(growth)
    length, growth = length[usable], growth[usable]
    if length.size < FEWEST_NEAR:
        return dict.fromkeys(FITTED, float("nan"))
    centre = length.mean()
    slope, level = np.polyfit(length - centre, growth.real, 1)
    if slope <= 0.0 or not length.min() <= centre - level / slope <= length.max():
        return dict.fromkeys(FITTED, float("nan"))
    turn, frequency = np.polyfit(length - centre, growth.imag, 1)
    crossing = centre - level / slope
    scatter = np.std(growth.real - level - slope * (length - centre), ddof=2) / slope
    lever = np.hypot(1.0, (crossing - centre) / length.std())
    values = (
        crossing, crossing - scatter, crossing + scatter, scatter * lever / np.sqrt(length.size),
        frequency + turn * (crossing - centre),
    )  # fmt: skip
    return dict(zip(FITTED, map(float, values), strict=True))
