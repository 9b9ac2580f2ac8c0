"""Measurements that several tests read."""

import pandas as pd
import pytest
from once import once

from benchmarks.manufactured import orders


@pytest.fixture(scope="session")
def convergence(tmp_path_factory):
    """Errors of all manufactured problems on all meshes and with all steps."""

    def make(path):
        orders.convergence().to_csv(path, index=False)

    return pd.read_csv(once(tmp_path_factory, "convergence.csv", make))
