"""The watch for the drop against a maximum taken anew over the whole window."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from nucleation.simulation.event import DropWatch

forces = st.lists(st.floats(0.0, 1e5) | st.sampled_from([0.0, 1.0, 100.0]), min_size=1, max_size=60)
seeds = st.integers(0, 2**32 - 1)


def series(values, seed):
    """Times that grow by unlike steps, some of them by none, and forces."""
    steps = np.random.default_rng(seed).choice([0.0, 1e-6, 0.01, 0.3, 2.0], size=len(values))
    return np.cumsum(steps), np.array(values)


def naive(times, forces, window, drop):
    """Whether each force is so far below the largest one of its window."""
    return [
        bool(force < (1.0 - drop) * forces[: i + 1][times[: i + 1] >= time - window].max())
        for i, (time, force) in enumerate(zip(times, forces, strict=True))
    ]


@given(forces, seeds, st.floats(0.0, 3.0), st.floats(0.0, 0.99))
def test_watch_is_the_naive_maximum(values, seed, window, drop):
    times, values = series(values, seed)
    watch = DropWatch(window, drop)
    found = [watch.dropped(*each) for each in zip(times.tolist(), values.tolist(), strict=True)]
    assert found == naive(times, values, window, drop)


@given(forces, seeds, st.floats(0.0, 3.0), st.data())
def test_watch_goes_on_from_its_maxima(values, seed, window, data):
    """They are all that a checkpoint needs to keep, and fall with time."""
    times, values = series(values, seed)
    cut = data.draw(st.integers(0, len(times)))
    watch, other = DropWatch(window), DropWatch(window)
    for i, each in enumerate(zip(times.tolist(), values.tolist(), strict=True)):
        if i == cut:
            other.maxima = watch.maxima
        dropped = watch.dropped(*each)
        assert i < cut or other.dropped(*each) == dropped
    assert (np.diff(watch.maxima[:, 0]) >= 0.0).all()
    assert (np.diff(watch.maxima[:, 1]) < 0.0).all()
