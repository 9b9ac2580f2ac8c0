"""What of a simulation is recorded: everything, the interface, or what lengths need."""

import dataclasses

from .checked import Checked
from .quantities import quantity

LEVELS = ("everything", "interface", "lengths")
"""Levels of recording, each a part of the one before it."""

STUCK_BELOW = 1e-4
"""Part of V below which a node is stuck for lengths: fields are zero there, but for its neighbours.

Edges of the patch are at larger slip rates, which configurations are held to.
"""


@dataclasses.dataclass(frozen=True)
class Recording(Checked):
    """What of a simulation is recorded."""

    record: str = quantity(
        "what of a simulation is recorded: everything; the interface, without snapshots of the "
        "bodies; or what lengths and the stability of the patch need, in single precision",
        choices=LEVELS, default="everything",
    )  # fmt: skip

    def covers(self, level: str) -> bool:
        """Whether all of another level is recorded."""
        return LEVELS.index(self.record) <= LEVELS.index(level)
