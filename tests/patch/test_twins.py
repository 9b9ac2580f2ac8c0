"""Twin runs: the same steps, a small kick, and its growth."""

import dataclasses

import numpy as np
import pytest

from nucleation.analysis.definitions import ExtractionSettings
from nucleation.model.linearised import interface_state
from nucleation.model.parameters import Geometry, Mesh, Parameters, Stepping
from nucleation.patch import twins
from nucleation.patch.tables import TWINS, gather_twins
from nucleation.patch.twins import difference, follow_twins
from nucleation.simulation.run import composed, run

pytestmark = pytest.mark.slow

PARAMETERS = Parameters(
    geometry=Geometry(height=0.1, length=3.2),
    mesh=Mesh(n_x=120, n_y=8, grading=4.0),
    stepping=Stepping(end_time=12.0, tolerance=5e-2, longest_step=0.1),
)
THEORY = 0.7949  # m


@pytest.fixture(scope="module")
def followed():
    return follow_twins(PARAMETERS, THEORY, ExtractionSettings(), shares=(0.43, 0.62))


def test_kicks_decay_below_and_grow_above_as_the_frozen_patch_says(followed):
    assert followed.sizes["twin"] == 2
    growth, frozen = followed["twin_growth"].values, followed["frozen_growth"].values
    assert growth[0] < -0.5 and frozen[0] < -0.5
    assert growth[1] > 0.5 and frozen[1] > 0.5
    np.testing.assert_allclose(growth, frozen, atol=0.6)
    np.testing.assert_allclose(followed["twin_frequency"], followed["frozen_frequency"], rtol=0.06)


def test_lengths_are_those_asked_for(followed):
    first, last = followed["twin_length_first"].values, followed["twin_length_last"].values
    np.testing.assert_allclose(first, np.array([0.43, 0.62]) * THEORY, rtol=0.05)
    mean = followed["twin_length"].values
    assert ((first < mean) & (mean < last)).all()


def test_twin_without_a_kick_is_the_run(monkeypatch):
    """It takes the very steps of the run, and the restarted state loses nothing."""
    monkeypatch.setattr(twins, "KICK", 0.0)
    settings = ExtractionSettings()
    patches, dynamics = twins.Patches(PARAMETERS, settings), composed(PARAMETERS)
    twin = None
    for instant in run(PARAMETERS):
        length = patches.length(instant.report)
        if twin is not None:
            twin.advance(instant, length)
        elif length > 0.3 * THEORY:
            twin = twins.Twin(patches, dynamics, instant)
            until = instant.state.time + 0.1
        if twin is not None and instant.state.time > until:
            break
    assert twin.state.time == pytest.approx(instant.state.time, rel=1e-12)
    nodes = np.arange(1, PARAMETERS.mesh.n_x + 1)
    change = difference(instant.state, twin.state, nodes)
    assert np.abs(change[: nodes.size]).max() < 1e-12 * PARAMETERS.geometry.length
    assert np.abs(change[nodes.size :]).max() < 1e-7


def test_table_has_a_row_for_each_twin(followed):
    description = {
        "id": "a", "study": "twin_runs", "role": "twin_runs", "parameters": PARAMETERS.to_dict(),
        "theory_length": THEORY, "interface": dataclasses.asdict(interface_state(PARAMETERS)),
    }  # fmt: skip
    table = gather_twins([description, description], [followed, followed])
    assert table.sizes["twin"] == 4
    assert set(table.data_vars) == set(TWINS)
    np.testing.assert_array_equal(table["twin_growth"], np.tile(followed["twin_growth"], 2))
    empty = gather_twins([], [])
    assert empty.sizes["twin"] == 0
