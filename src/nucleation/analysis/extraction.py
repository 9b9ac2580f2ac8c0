"""The critical nucleation length, read from a simulation by the drop of its driving force.

It is the patch's length at the onset (both in :mod:`.definitions`). The error bar spans other
reasonable definitions: edges from 0.5 V to 1e-3 V, and instants up to the one where the drop is
complete.
"""

from __future__ import annotations

import warnings

import numpy as np
import xarray as xr

from ..simulation.outcome import Outcome
from .definitions import ExtractionSettings
from .record import Record

AFTER_EVENT = Outcome.AFTER_EVENT.value

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
    ``length_high`` (m); all NaN if the run has no event, with a warning if it had one and ended
    before the force fell by the settings' drop.
    """
    record = Record(simulation, settings)
    if record.onset is None:
        recorded = record.parameters.stepping.event_drop
        if settings.drop > recorded and simulation.attrs.get("status") == AFTER_EVENT:
            warnings.warn(
                f"the run ended after its event, a drop of the force by {recorded:g}, and before "
                f"it fell by drop = {settings.drop:g}: simulate with a larger stepping.event_drop "
                "or time_after_event",
                UserWarning,
                stacklevel=2,
            )
        return dict.fromkeys(NAMES, float("nan"))
    instants = record.drop_times
    edges = np.array([lengths[record.frames_at(instants)] for lengths in record.all_lengths])
    values = (instants[0], instants.min(), instants.max(), edges[0, 0], edges.min(), edges.max())
    return dict(zip(NAMES, map(float, values), strict=True))
