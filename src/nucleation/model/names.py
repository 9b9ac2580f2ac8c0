"""Names of parameters: the full one says the group, ``geometry.height``, short ones are aliases."""

from collections import Counter
from collections.abc import Mapping

from .quantities import ParameterError, Quantity


class Names(dict[str, Quantity]):
    """Declarations of parameters by their full names, and the short names that stand for them.

    The last part of a full name is a short one if no other parameter has it too; aliases are short
    ones by agreement, and stronger.

    Parameters
    ----------
    entries : mapping
        Declarations by full name, ``group.field``.
    aliases : dict
        Full names by alias.
    """

    def __init__(self, entries: Mapping[str, Quantity], aliases: dict[str, str]) -> None:
        super().__init__(entries)
        lasts = {full: full.rpartition(".")[2] for full in entries}
        having = Counter(lasts.values())
        self._meant = {last: full for full, last in lasts.items() if having[last] == 1} | aliases
        alias = {full: name for name, full in aliases.items()}
        self._short = {
            full: alias.get(full) or (last if self._meant.get(last) == full else full)
            for full, last in lasts.items()
        }

    def full(self, name: str) -> str:
        """The full name that a full or short name stands for; ParameterError if for none."""
        if name not in self and name not in self._meant:
            raise ParameterError(f"there is no parameter {name}")
        return name if name in self else self._meant[name]

    def short(self, full: str) -> str:
        """The name by which a parameter goes: its alias, its last part, or the full name."""
        return self._short[full]

    def others(self, full: str) -> list[str]:
        """All names of a parameter but the one by which it goes."""
        names = [full, *(name for name, meant in self._meant.items() if meant == full)]
        return [name for name in names if name != self.short(full)]
