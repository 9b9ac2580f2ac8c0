"""Which data a simulation records: everything, the interface, or the data for lengths."""

import dataclasses

from .checked import Checked
from .quantities import quantity

LEVELS = ("everything", "interface", "lengths")
"""Levels of recording, each a part of the previous one."""

STUCK_BELOW = 1e-4
"""With the level ``lengths``, nodes with slip rates below this fraction of V count as stuck.

Their fields are zero in the record, except beside slipping nodes. Configurations must locate the
edges of the patch at larger slip rates.
"""


@dataclasses.dataclass(frozen=True)
class Recording(Checked):
    """Which data a simulation records.

    Examples
    --------
    >>> Recording(record="interface").record
    'interface'
    """

    record: str = quantity(
        "recorded data of a simulation: everything; the interface, without snapshots of the "
        "bodies; or only the data for lengths and the stability of the patch, in single precision",
        choices=LEVELS,
        default="everything",
    )

    def covers(self, level: str) -> bool:
        """Whether the record contains all data of another level."""
        return LEVELS.index(self.record) <= LEVELS.index(level)
