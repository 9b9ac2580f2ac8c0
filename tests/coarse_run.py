"""A run through nucleation on a coarse mesh, simulated once for all tests that read one."""

import pytest

from nucleation.extraction.definitions import ExtractionSettings
from nucleation.simulation.run import simulate
from replication.configuration.load import configure
from replication.tables import lengths

CONFIG = {
    "stepping": {"end_time": 30.0, "time_after_event": 0.2, "tolerance": 0.05, "longest_step": 0.2},
    "studies": {
        "paper": {
            "role": "paper",
            "length_over_critical": 4.0,
            "interface": "main_text",
            "runs": [{"height": 0.005, "n_x": 60, "n_y": 6}],
        }
    },
}


@pytest.fixture(scope="session")
def settings():
    return configure(CONFIG)


@pytest.fixture(scope="session")
def simulation(settings):
    """The record of the run."""
    return simulate(settings.runs[0].run)


@pytest.fixture(scope="session")
def table(settings, simulation):
    """The table of its lengths."""
    return lengths.lengths_table([settings.runs[0].to_dict()], [simulation], ExtractionSettings())
