"""Measurements that several tests read."""

import pytest

from nucleation.verification.orders import convergence_dataset


@pytest.fixture(scope="session")
def convergence():
    """Errors of all manufactured problems on all meshes and with all steps."""
    return convergence_dataset()
