"""Functions compiled by numba, and kept for other processes: written by one at a time.

Two processes that compile a function for different arguments at once may each count the other's
code as their own (numba 0.68 numbers its files without a lock), and run it on other arrays.
"""

import contextlib
import fcntl
import hashlib
import os
import time
from collections.abc import Callable, Iterator, Set
from typing import Any, cast

from numba import njit
from numba.core.caching import FunctionCache


class SharedCache(FunctionCache):
    """What numba keeps of a function and some content, read and written by many processes."""

    def __init__(self, function: Callable[..., Any], content: str) -> None:
        super().__init__(function)
        self._digest = hashlib.sha256(content.encode()).hexdigest()

    def _index_key(self, *compiled: Any) -> tuple[Any, ...]:
        return *super()._index_key(*compiled), self._digest

    def save_overload(self, sig: Any, data: Any) -> None:
        """Keep the code for some types of arguments."""
        with self._locked(fcntl.LOCK_EX):
            super().save_overload(sig, data)

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        """The code for some types of arguments, None if it is not kept."""
        with self._locked(fcntl.LOCK_SH):
            return super().load_overload(sig, target_context)

    @contextlib.contextmanager
    def _locked(self, kind: int) -> Iterator[None]:
        """Hold the directory's lock, where the disk has any: many may read, or one may write."""
        with contextlib.ExitStack() as held:
            with contextlib.suppress(OSError):
                self._impl.locator.ensure_cache_path()
                file = held.enter_context(open(os.path.join(self.cache_path, "lock"), "a"))
                for _ in range(1000):  # ten seconds: a process that is stopped may hold it for ever
                    with contextlib.suppress(BlockingIOError):
                        fcntl.flock(file, kind | fcntl.LOCK_NB)
                        break
                    time.sleep(0.01)
            yield


def compiled(
    function: Callable[..., Any], fastmath: Set[str] = frozenset(), content: str = ""
) -> Callable[..., Any]:
    """Compile a function, with numpy's errors and, without `fastmath`, numpy's last bits.

    `content` is the text of what it calls in other files, which numba does not look at.
    """
    made: Any = njit(function, error_model="numpy", fastmath=set(fastmath) or False)
    with contextlib.suppress(RuntimeError):  # no place to keep it
        made._cache = SharedCache(function, content)
    return cast(Callable[..., Any], made)
