"""Names of parameters: full names have the group, ``geometry.height``; short ones are aliases."""

from collections import Counter
from collections.abc import Mapping

from .quantities import ParameterError, Quantity


class Names(dict[str, Quantity]):
    """Declarations of parameters by full name, with the short names of each parameter.

    The last part of a full name is a short name if it is unique. An alias is an additional short
    name; it has precedence.

    Parameters
    ----------
    entries : mapping
        Declarations by full name, ``group.field``.
    aliases : dict
        Full names by alias.
    """

    def __init__(
        self,
        entries: Mapping[str, Quantity],
        aliases: dict[str, str],
    ) -> None:
        super().__init__(entries)
        occurrences = Counter(map(_last_part, entries))
        self._full_names = {}
        for full in entries:
            last = _last_part(full)
            if occurrences[last] == 1 and f"second_{last}" not in aliases:
                self._full_names[last] = full
        self._full_names |= aliases

        self._short_names = {}
        for full in entries:
            last = _last_part(full)
            unique = self._full_names.get(last) == full
            self._short_names[full] = last if unique else full
        for alias, full in aliases.items():
            self._short_names[full] = alias

    def full(self, name: str) -> str:
        """The full name of a parameter, from any of its names.

        Raises
        ------
        ParameterError
            If no parameter has the name.
        """
        full = name if name in self else self._full_names.get(name)
        if full is None:
            raise ParameterError(f"there is no parameter {name}")
        return full

    def short(self, full: str) -> str:
        """The standard name of a parameter: its alias, its last part, or the full name."""
        return self._short_names[full]

    def others(self, full: str) -> list[str]:
        """All names of a parameter except the standard one."""
        names = [full]
        for name, meant in self._full_names.items():
            if meant == full:
                names.append(name)
        standard = self.short(full)
        return [name for name in names if name != standard]


def _last_part(full: str) -> str:
    return full.rpartition(".")[2]
