"""Any arrays kept in a checkpoint are loaded again, and any damage to it is noticed."""

import io
import string

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from nucleation.simulation.checkpoints import Checkpoint

names = st.text(string.ascii_letters + "_", min_size=1, max_size=12).filter(
    lambda name: name not in ("fingerprint", "content", "file", "args", "kwds")
)
types = st.sampled_from(["f8", "f4", "i8", "c16", "?"]).map(np.dtype)
shapes = arrays.array_shapes(min_dims=0, min_side=0)
kept = st.dictionaries(names, types.flatmap(lambda kind: arrays.arrays(kind, shapes)), max_size=5)


def checkpoint(path, fingerprint="this run"):
    return Checkpoint(path, fingerprint, every=0.0, log=io.StringIO())


@settings(max_examples=60)
@given(kept)
def test_round_trip(tmp_path_factory, stored):
    path = tmp_path_factory.getbasetemp() / "round_trip.npz"
    checkpoint(path).keep(lambda: stored)
    loaded = checkpoint(path).load()
    assert loaded.keys() == stored.keys()
    for name, values in stored.items():
        assert loaded[name].dtype == values.dtype
        np.testing.assert_array_equal(loaded[name], values)
    assert checkpoint(path, "another run").load() is None


@settings(max_examples=60)
@given(st.data())
def test_damage_anywhere_is_noticed_or_without_effect(tmp_path_factory, data):
    path = tmp_path_factory.getbasetemp() / "damaged.npz"
    stored = {"slip": np.linspace(0.0, 1.0, 30), "steps": np.array(7)}
    checkpoint(path).keep(lambda: stored)
    whole = path.read_bytes()
    place = data.draw(st.integers(0, len(whole) - 1))
    value = data.draw(st.integers(0, 255))
    path.write_bytes(whole[:place] + bytes([value]) + whole[place + 1 :])
    loaded = checkpoint(path).load()
    if loaded is not None:
        assert loaded.keys() == stored.keys()
        for name, values in stored.items():
            np.testing.assert_array_equal(loaded[name], values)
