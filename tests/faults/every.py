"""Every fault: importing a module of them enters them into the registry."""

import batches
import company
import damage
import disks
import kills
import reuse
from registry import FAULTS

__all__ = ["FAULTS"]
MODULES = (kills, batches, disks, damage, company, reuse)
