"""Functions compiled by numba, and cached on disk; one process at a time writes the cache.

Two processes that compile a function for different arguments at once may each load the other's code
as their own (numba 0.68 numbers its files without a lock), and run it on the wrong arrays.

This is the only file with private parts of numba: those of ``FunctionCache`` that are overridden or
called here, and ``_cache`` of a compiled function. So pyproject.toml bounds its version.
"""

import contextlib
import fcntl
import hashlib
import os
import time
from collections.abc import Callable, Iterator, Set
from typing import Any, TypeVar

from numba import njit
from numba.core.caching import FunctionCache

Result = TypeVar("Result")

LOCK_ATTEMPTS = 1000  # ten seconds: a process that is stopped keeps its lock
LOCK_INTERVAL = 0.01  # s


class _SharedCache(FunctionCache):
    """Numba's cache of a function and some content, shared by many processes."""

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
        """Return the code for some types of arguments, None if there is none."""
        with self._locked(fcntl.LOCK_SH):
            return super().load_overload(sig, target_context)

    @contextlib.contextmanager
    def _locked(self, kind: int) -> Iterator[None]:
        """Hold a lock of the directory, if the disk has locks: many may read, or one may write."""
        with contextlib.ExitStack() as held:
            with contextlib.suppress(OSError):
                self._impl.locator.ensure_cache_path()
                path = os.path.join(self.cache_path, "lock")
                file = held.enter_context(open(path, "a"))
                for _ in range(LOCK_ATTEMPTS):
                    with contextlib.suppress(BlockingIOError):
                        fcntl.flock(file, kind | fcntl.LOCK_NB)
                        break
                    time.sleep(LOCK_INTERVAL)
            yield


def compiled(
    function: Callable[..., Result], fastmath: Set[str] = frozenset(), content: str = ""
) -> Callable[..., Result]:
    """Compile a function, with numpy's treatment of errors.

    `fastmath` are LLVM's liberties with floating-point numbers; without any, the last bits are
    numpy's. `content` is the text of the code that it calls in other files, at which numba does
    not look: if it changes, the function is compiled again.
    """
    dispatcher: Any = njit(function, error_model="numpy", fastmath=set(fastmath) or False)
    with contextlib.suppress(RuntimeError):  # there is no place for a cache
        dispatcher._cache = _SharedCache(function, content)
    made: Callable[..., Result] = dispatcher
    return made


FUSED_AND_REORDERED = frozenset({"contract", "reassoc", "nsz"})


def compiled_loop(function: Callable[..., Result]) -> Callable[..., Result]:
    """Compile a loop over modes; LLVM may fuse products with sums and reorder sums."""
    return compiled(function, FUSED_AND_REORDERED)
