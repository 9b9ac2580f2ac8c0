"""Which data a simulation records: the fields of the interface, or the data for lengths."""

import dataclasses

from .checked import Checked
from .quantities import quantity

STUCK_BELOW = 1e-4
"""With ``record: lengths``, nodes with slip rates below this fraction of V count as stuck.

Their fields are zero in the record, except beside slipping nodes. Configurations must locate the
edges of the patch at larger slip rates.
"""


@dataclasses.dataclass(frozen=True)
class Recording(Checked):
    """Which data a simulation records.

    Examples
    --------
    >>> Recording(record="lengths").record
    'lengths'
    """

    record: str = quantity(
        "recorded data of a simulation: all fields of the interface; or only the data for lengths "
        "and the stability of the patch, in single precision",
        choices=("interface", "lengths"),
        default="interface",
    )
