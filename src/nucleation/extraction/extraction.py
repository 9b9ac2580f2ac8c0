"""The critical nucleation length, read from a simulation by the drop of its driving force.

It is the patch's length at the onset (both in :mod:`.definitions`). The error bar spans other
reasonable definitions: edges from 0.5 V to 1e-3 V, and instants up to the one where the drop is
complete.
"""

import warnings

import xarray as xr

from ..datasets.variables import Variable
from ..simulation.event import Outcome
from .definitions import ExtractionSettings
from .record import Record

MEASURED = {
    "onset_time": Variable("s", "onset of the event", "t"),
    "onset_time_low": Variable("s", "earliest onset over the definitions of the drop", "t"),
    "onset_time_high": Variable("s", "latest onset over the definitions of the drop", "t"),
    "length": Variable("m", "length at the drop", "L"),
    "length_low": Variable("m", "smallest length over the definitions", "L"),
    "length_high": Variable("m", "largest length over the definitions", "L"),
}
"""Results of :func:`extract`."""


def extract(
    simulation: xr.Dataset,
    settings: ExtractionSettings = ExtractionSettings(),
) -> dict[str, float]:
    """Read onset and critical length from one simulation.

    A warning is given if the run had an event, and ended before the force fell by the settings'
    drop.

    Parameters
    ----------
    simulation : Dataset
        Record of a run.
    settings : ExtractionSettings
        Definitions of the patch's edge and of the drop.

    Returns
    -------
    dict
        :data:`MEASURED` by name (s, m); all NaN if the run has no event.

    Examples
    --------
    >>> from nucleation.api import PAPER, Run, simulate
    >>> run = Run(PAPER, block_length=0.9, n_x=16, n_y=2, end_time=0.02)
    >>> extract(simulate(run))["length"]  # the run ends before its event
    nan
    """
    record = Record(simulation, settings)
    if record.onset is None:
        _warn_of_early_end(record)
        return dict.fromkeys(MEASURED, float("nan"))
    instants = record.drop_times
    edges = record.lengths_at_drop
    return {
        "onset_time": float(instants[0]),
        "onset_time_low": float(instants.min()),
        "onset_time_high": float(instants.max()),
        "length": float(edges[0, 0]),
        "length_low": float(edges.min()),
        "length_high": float(edges.max()),
    }


def _warn_of_early_end(record: Record) -> None:
    """Warn if the run ended after an event by a smaller drop than that of the settings."""
    recorded = record.run.stepping.event_drop
    drop = record.settings.drop
    status = str(record.simulation.attrs.get("status"))
    if drop > recorded and status.startswith(Outcome.AFTER_EVENT.value):
        warnings.warn(
            f"the run ended after its event, a drop of the force by {recorded:g}, and before "
            f"it fell by drop = {drop:g}: simulate with a larger stepping.event_drop "
            "or time_after_event",
            UserWarning,
            stacklevel=3,
        )
