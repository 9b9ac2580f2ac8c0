"""The regularised Dieterich-Ruina law through a whole coarse run, with either evolution."""

import numpy as np
import pytest

from nucleation.analysis.extraction import extract
from nucleation.configuration.load import configure
from nucleation.model.friction.registry import EVOLUTIONS
from nucleation.model.parameters import Parameters
from nucleation.simulation.run import simulate

STUDY = {
    "length_over_critical": 4.0,
    "defaults": {
        "friction.law": "dieterich_ruina", "mesh.n_x": 60, "mesh.n_y": 6, "tolerance": 0.05,
        "longest_step": 0.2, "time_after_event": 0.0,
    },
    "runs": [{"geometry.height": 0.02, "friction.evolution": list(EVOLUTIONS)}],
}  # fmt: skip
RUNS = configure({"studies": {"s": STUDY}}).runs


@pytest.mark.slow
@pytest.mark.parametrize("run", RUNS, ids=lambda run: run.id)
def test_the_patch_nucleates(run):
    record = simulate(run.parameters)
    assert record.attrs["completed"] and "event" in record.attrs["status"]
    assert record.attrs["rejected_steps"] < 0.5 * record.attrs["steps"]
    found = extract(record)
    assert 0.4 < found["length"] / run.theory_length < 1.0
    # as its record says, the interface slips under the strength of this law, far ahead as well
    law = Parameters.from_json(record.attrs["parameters"]).friction
    assert law == run.parameters.friction and law.law == "dieterich_ruina"
    rate, state = record["slip_rate"].values[5:, 1:], record["state"].values[5:, 1:]
    stress, normal = record["shear_stress"].values[5:, 1:], record["normal_stress"].values[5:, 1:]
    strength = law.coefficient(rate, state) * np.abs(normal)
    close = np.abs(np.abs(stress) - np.abs(strength)) < 1e-3 * np.abs(normal)
    assert close.mean() > 0.99
    assert np.abs(rate).min() < 1e-30 < np.abs(rate).max()  # stuck and slipping
