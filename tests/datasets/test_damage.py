"""Damage of all sorts at random: a file is read as it was written, or refused in one way.

Each file is read by a process of its own, as damaged bytes might end or hang it. For a campaign:
``NUCLEATION_DAMAGES=3000 pytest tests/datasets/test_damage.py``.
"""

import collections
import contextlib
import os
import random
import signal
import traceback

import numpy as np
import pytest
import xarray as xr
from declared import VARIABLES

from nucleation.datasets import netcdf
from nucleation.datasets.variables import DatasetError, annotate

COUNT = int(os.environ.get("NUCLEATION_DAMAGES", "120"))
HANGS = 20  # s
WHOLE, REFUSED, WRONG, RAISED = range(4)


def numbers():
    rate = np.random.default_rng(1).random((40, 30))
    return xr.Dataset(
        {"slip_rate": (("time", "x"), rate), "velocity": 1e-5, "steps": 40},
        {"time": np.arange(40.0), "x": np.linspace(0.0, 1.0, 30)},
    )


def texts():
    columns = {
        "id": [f"study-aging-H{n}-φ{n}" for n in range(30)],
        "evolution": ["aging"] * 30,
        "length": np.arange(30.0),
    }
    return xr.Dataset({name: ("run", values) for name, values in columns.items()})


def flip(content, random):
    for _ in range(random.choice((1, 1, 1, 3, 30))):
        content[random.randrange(len(content))] ^= 1 << random.randrange(8)


def truncate(content, random):
    del content[random.randrange(len(content)) :]


def overwrite(content, random):
    """Zeros or noise in the place of some bytes."""
    begin, size = random.randrange(len(content)), random.choice((1, 8, 64, 512, 4096))
    size = min(size, len(content) - begin)
    content[begin : begin + size] = random.choice((bytes, random.randbytes))(size)


def swap(content, random):
    size = random.choice((8, 64, 512))
    one, other = (random.randrange(len(content) // size) * size for _ in range(2))
    first, second = content[one : one + size], content[other : other + size]
    content[one : one + size], content[other : other + size] = second, first


def reading(path, written):
    """How reading ends."""
    try:
        return WHOLE if netcdf.read(path).identical(written) else WRONG
    except DatasetError:
        with contextlib.suppress(DatasetError):
            netcdf.attributes(path)
        return REFUSED


def outcome(path, written):
    """The same, by a process of its own; the number of a signal as a negative one."""
    child = os.fork()
    if child == 0:
        signal.alarm(HANGS)
        status = RAISED
        try:
            status = reading(path, written)
        except BaseException:
            traceback.print_exc()
        os._exit(status)
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore:.*multi-threaded")  # a child only reads
@pytest.mark.parametrize("make", [numbers, texts])
def test_damage_is_refused_in_one_way(make, tmp_path):
    path = tmp_path / "record.nc"
    made = annotate(make(), VARIABLES)
    netcdf.write(made, path, parameters='{"n": [1]}', sources="{}", code_digest="1")
    written, whole = netcdf.read(path), path.read_bytes()
    found, odd = collections.Counter(), []
    for seed in range(COUNT):
        generator, content = random.Random(seed), bytearray(whole)
        damage = generator.choice((flip, truncate, overwrite, overwrite, swap))
        damage(content, generator)
        path.write_bytes(content)
        ended = outcome(path, written)
        found[ended] += 1
        if ended not in (WHOLE, REFUSED):
            odd.append((seed, damage.__name__, ended))
    print(make.__name__, dict(found))
    assert not odd
    assert found[REFUSED] > COUNT / 4
