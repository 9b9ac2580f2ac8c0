"""Measurements that several tests read."""

import pytest
import xarray as xr
from once import once

from replication.verification.orders import convergence_dataset


@pytest.fixture(scope="session")
def convergence(tmp_path_factory):
    """Errors of all manufactured problems on all meshes and with all steps."""

    def make(path):
        convergence_dataset().to_netcdf(path)

    return xr.load_dataset(once(tmp_path_factory, "convergence.nc", make))
