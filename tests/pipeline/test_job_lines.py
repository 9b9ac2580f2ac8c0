"""One line for each job: only where a profile leaves the reasons of jobs out."""

import logging
from enum import Enum

import pytest

from replication.pipeline.job_lines import shorten


class Kinds(Enum):
    """As Snakemake's kinds of lines."""

    RULES = "rules"
    REASON = "reason"


@pytest.mark.parametrize(
    ("quiet", "filters"),
    [(None, 0), ([], 0), ([Kinds.RULES], 0), ([Kinds.REASON], 1)],
)
def test_jobs_take_one_line_unless_their_reasons_are_printed(quiet, filters):
    logger = logging.Logger("snakemake")
    shorten(logger, quiet)
    shorten(logger, quiet)
    assert len(logger.filters) == filters
