"""Names of parameters: the full one says the group, ``geometry.height``, short ones are aliases."""

from collections import defaultdict
from collections.abc import Iterator, Mapping
from functools import cached_property

from .quantities import ParameterError, Quantity


class Names(Mapping[str, Quantity]):
    """Declarations of parameters by their full names, and the short names that stand for them.

    The last part of a full name is a short one as long as no other parameter has it too; aliases
    are short ones by agreement, and stronger.

    Parameters
    ----------
    entries : mapping
        Declarations by full name, ``group.field``.
    aliases : mapping
        Full names by alias.
    """

    def __init__(self, entries: Mapping[str, Quantity], aliases: Mapping[str, str]) -> None:
        self._entries = dict(entries)
        self._meant: dict[str, list[str]] = defaultdict(list)
        for full in entries:
            self._meant[full.rpartition(".")[2]].append(full)
        self._meant |= {alias: [full] for alias, full in aliases.items()}
        self._alias = {full: alias for alias, full in aliases.items()}

    def __getitem__(self, name: str) -> Quantity:
        return self._entries[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._entries)

    def __len__(self) -> int:
        return len(self._entries)

    def full(self, name: str) -> str:
        """The full name that a full or short name stands for.

        Raises
        ------
        ParameterError
            If it stands for none or for several, which are listed.
        """
        if name in self._entries:
            return name
        meant = self._meant.get(name, [])
        if len(meant) == 1:
            return meant[0]
        if meant:
            raise ParameterError(f"{name} is ambiguous: it may be {' or '.join(meant)}")
        raise ParameterError(f"there is no parameter {name}")

    def short(self, full: str) -> str:
        """The name by which a parameter goes: its alias, its last part, or the full name."""
        last = full.rpartition(".")[2]
        return self._alias.get(full) or (last if self._meant[last] == [full] else full)

    @cached_property
    def by_short(self) -> dict[str, Quantity]:
        """Declarations by the name by which a parameter goes."""
        return {self.short(full): entry for full, entry in self._entries.items()}

    def others(self, full: str) -> list[str]:
        """All names of a parameter but the one by which it goes."""
        names = [full, *(name for name, meant in self._meant.items() if meant == [full])]
        return [name for name in names if name != self.short(full)]

    @property
    def ambiguous(self) -> list[str]:
        """Short names that stand for several parameters, and so for none."""
        return [name for name, meant in self._meant.items() if len(meant) > 1]
