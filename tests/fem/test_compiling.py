"""What numba keeps is right, whichever processes write at once."""

import fcntl
import inspect
import subprocess
import sys

import pytest
from numba import njit
from numba.core.caching import FunctionCache

DOUBLING = """
from nucleation.fem.compiling import compiled

@compiled
def doubled(x):
    return 2 * x
"""
TWO_AT_ONCE = """
import sys, time
from numba.core.caching import IndexDataCacheFile
sys.path.insert(0, sys.argv[1])
import doubling

def slow(self, overloads, save=IndexDataCacheFile._save_index):
    time.sleep(1.0)  # the other one has read the index in this time
    save(self, overloads)

IndexDataCacheFile._save_index = slow
assert doubling.doubled({}) == {}
"""
KEPT = """
import sys
from nucleation.fem import compiling
compiling.LOCK_ATTEMPTS = 20
sys.path.insert(0, sys.argv[1])
from doubling import doubled

print(doubled(3), doubled(2.5), len(doubled.stats.cache_misses))
"""


PRIVATE = {
    "__init__": ["self", "py_func"],
    "_index_key": ["self", "sig", "codegen"],
    "save_overload": ["self", "sig", "data"],
    "load_overload": ["self", "sig", "target_context"],
}
"""What of numba's cache the shared one overrides, and the arguments."""


@pytest.mark.parametrize("name", PRIVATE)
def test_private_parts_of_numba_are_those_that_the_shared_cache_overrides(name):
    """A new numba that fails here needs a change of compiling.py before its bound is raised."""
    assert list(inspect.signature(getattr(FunctionCache, name)).parameters) == PRIVATE[name]


def test_private_parts_of_numba_are_those_that_the_shared_cache_uses():
    def function(x):
        return x

    made = njit(function)
    assert hasattr(made, "_cache"), "in which a compiled function looks for its code"
    made.enable_caching()
    assert type(made._cache) is FunctionCache
    assert made._cache.cache_path == made._cache._impl.locator.get_cache_path()
    assert callable(made._cache._impl.locator.ensure_cache_path)


@pytest.fixture(autouse=True)
def doubling(tmp_path, monkeypatch):
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "kept"))
    (tmp_path / "doubling.py").write_text(DOUBLING)


@pytest.mark.slow
def test_two_processes_compile_for_other_arguments_at_once(tmp_path):
    """A third one finds what both have compiled."""
    programs = (TWO_AT_ONCE.format(x, 2 * x) for x in (3, 2.5))
    running = [subprocess.Popen([sys.executable, "-c", p, str(tmp_path)]) for p in programs]
    assert [process.wait() for process in running] == [0, 0]
    command = [sys.executable, "-c", KEPT, str(tmp_path)]
    third = subprocess.run(command, check=True, capture_output=True, text=True)
    assert third.stdout.split() == ["6", "5.0", "0"]


WITH_CONTENT = """
import sys
import doubling

def function(x):
    return doubling.doubled(x)

made = doubling.compiled(function, content=sys.argv[1])
made(3)
print(len(made.stats.cache_hits))
"""


@pytest.mark.slow
def test_what_is_kept_is_not_used_once_other_content_is_called(tmp_path):
    (program := tmp_path / "program.py").write_text(WITH_CONTENT)
    hits = []
    for content in ("one", "one", "other"):
        command = [sys.executable, str(program), content]
        hits.append(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
    assert hits == ["0\n", "1\n", "0\n"]


@pytest.mark.slow
@pytest.mark.parametrize("kind", [fcntl.LOCK_SH, fcntl.LOCK_EX], ids=["reads", "writes"])
def test_process_that_is_stopped_while_it_holds_the_lock_does_not_stop_others(kind, tmp_path):
    command = [sys.executable, "-c", KEPT, str(tmp_path)]
    subprocess.run(command, check=True)
    (lock,) = (tmp_path / "kept").rglob("lock")
    with lock.open("a") as held:
        fcntl.flock(held, kind)
        found = subprocess.run(command, check=True, capture_output=True, text=True, timeout=100)
    assert found.stdout.split() == ["6", "5.0", "0"]
