"""The critical nucleation length, read from a simulation by the drop of its driving force.

It is the patch's length at the onset (both in :mod:`.definitions`). The error bar spans other
reasonable definitions: edges from 0.5 V to 1e-3 V, and instants up to the one where the drop is
complete.
"""

from __future__ import annotations

import numpy as np
import xarray as xr

from .definitions import ExtractionSettings
from .record import Record

NAMES = (
    "onset_time", "onset_time_low", "onset_time_high", "length", "length_low", "length_high",
)  # fmt: skip


def extract(
    simulation: xr.Dataset, settings: ExtractionSettings = ExtractionSettings()
) -> dict[str, float]:
    """Onset time and critical length of one simulation, each with its spread.

    Parameters
    ----------
    simulation : the record of :func:`nucleation.simulation.run.simulate`.
    settings : definitions of the patch's edge.

    Returns
    -------
    ``onset_time``, ``onset_time_low``, ``onset_time_high`` (s) and ``length``, ``length_low``,
    ``length_high`` (m); all NaN if the run has no event.
    """
    record = Record(simulation, settings)
    if record.onset is None:
        return dict.fromkeys(NAMES, float("nan"))
    instants = record.drop_times
    edges = np.array([lengths[record.frames_at(instants)] for lengths in record.all_lengths])
    values = (instants[0], instants.min(), instants.max(), edges[0, 0], edges.min(), edges.max())
    return dict(zip(NAMES, map(float, values), strict=True))
