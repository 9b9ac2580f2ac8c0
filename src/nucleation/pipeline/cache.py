"""Snakemake's between-workflow cache of simulations, with a check of what comes out of it."""

from __future__ import annotations

import threading
from pathlib import Path

from snakemake.caching.local import OutputFileCache
from snakemake.jobs import Job
from snakemake.logging import logger

from ..datasets import netcdf
from ..datasets.variables import DatasetError

READING = threading.Lock()
"""Snakemake fetches in several threads, which HDF5 does not bear."""


class CheckedCache(OutputFileCache):
    """A cache of datasets, shared between checkouts and users, that hands out no damaged one.

    Snakemake takes any file of the right name for the result. Here a damaged entry is taken out
    of the cache with a warning; the job then runs, and its result is stored anew.
    """

    async def fetch(self, job: Job) -> None:
        """Link the job's output to its entry in the cache.

        Raises
        ------
        CacheMissException
            If there is none, or it was damaged.
        """
        for _, entry in await self.get_outputfiles_and_cachefiles(job):
            _remove_if_damaged(entry)
        await super().fetch(job)


def _remove_if_damaged(entry: Path) -> None:
    if not entry.exists():
        return
    try:
        with READING:
            netcdf.read(entry)
    except DatasetError as error:
        logger.warning(f"The cache's entry is removed and computed again: {error}")
        entry.unlink(missing_ok=True)
