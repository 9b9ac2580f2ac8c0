"""Batches: the results of one job, made on several cores and shown one by one."""

import sys
from collections.abc import Callable, Sequence
from typing import Any

from .messages import LOGGER
from .recipes import PartFailed, Recipe
from .side_by_side import side_by_side
from .views import show


class Inputs(Sequence[Any]):
    """The sources of one role; each is read when it is needed.

    Parameters
    ----------
    open : callable
        Reads the source at a path.
    paths : list of str
        The paths.
    """

    def __init__(self, open: Callable[[str], Any], paths: list[str]) -> None:
        self._open = open
        self._paths = paths

    def __len__(self) -> int:
        return len(self._paths)

    def __getitem__(self, i: Any) -> Any:
        return self._open(self._paths[i])


class Batch:
    """The results of a batch.

    Parameters
    ----------
    result : callable
        Makes the result of a recipe.
    parts : sequence of Recipe
        Recipes of the results.
    cores : int
        Number of results that are made at the same time.
    """

    def __init__(
        self,
        result: Callable[[Recipe], Any],
        parts: Sequence[Recipe],
        cores: int,
    ) -> None:
        self._result = result
        self._parts = parts
        self._cores = cores
        self._failures: list[str] = []

    def map(self, function: Callable[[int, Any], Any] | None = None) -> list[Any]:
        """Make all results, and call a function with the number and the result of each.

        Parameters
        ----------
        function : callable, optional
            It is called in the process that makes the result.

        Returns
        -------
        list
            The values of the function, without those of failed parts.
        """
        names = [part.name for part in self._parts]
        values = []
        for failure, value in side_by_side(lambda i: self._one(i, function), names, self._cores):
            if failure:
                self._failures.append(failure)
            else:
                values.append(value)
        return values

    def _one(
        self,
        number: int,
        function: Callable[[int, Any], Any] | None,
    ) -> tuple[str, Any]:
        """Why a part has failed, and the value of the function if it has not."""
        part = self._parts[number]
        try:
            result = self._result(part)
        except PartFailed as error:
            LOGGER.info(error)
            return str(error), None
        show(part)
        return "", None if function is None else function(number, result)

    def end_on_failures(self) -> None:
        """Raise SystemExit if a part has failed; it is called after all parts were tried."""
        if not self._failures:
            return
        if len(self._parts) == 1:
            sys.exit(self._failures[0])
        count = f"{len(self._failures)} of {len(self._parts)} runs failed, the others are kept:"
        sys.exit("\n  ".join([count, *self._failures]))
