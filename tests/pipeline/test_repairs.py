"""What Snakemake leaves out is said after all."""

import logging
from types import SimpleNamespace

import pytest
import snakemake.jobs
from nucleation.pipeline.repairs import caption_where_made, show_why_groups_fail
from snakemake.io import IOFile, flag, is_flagged

REFUSED = "SLURM sbatch failed. The error message was 'sbatch: error: invalid partition: nope'."


@pytest.fixture
def group(monkeypatch):
    monkeypatch.setattr(snakemake.jobs.GroupJob, "log_error", snakemake.jobs.GroupJob.log_error)
    group = object.__new__(snakemake.jobs.GroupJob)
    group.groupid, group.jobs = "simulations", frozenset()
    return group


def test_group_that_is_refused_says_why_once(group, caplog):
    show_why_groups_fail()
    show_why_groups_fail()  # as when the Snakefile is read again
    with caplog.at_level(logging.ERROR):
        group.log_error(f"{REFUSED}\n    sbatch call:\n        sbatch --wrap=...", aux_logs=[])
    said = [record.getMessage() for record in caplog.records]
    assert said == [f"Group simulations: {REFUSED}", "Error in group simulations"]


def test_group_that_is_told_nothing_says_what_it_did_before(group, caplog):
    show_why_groups_fail()
    with caplog.at_level(logging.ERROR):
        group.log_error()
    assert [record.getMessage() for record in caplog.records] == ["Error in group simulations"]


def test_file_for_the_report_is_its_makers_alone():
    made = IOFile(flag(flag("figure.png", "report", "its caption"), "ensure", "x"), rule=None)
    named = IOFile(made._file, rule=None)
    target = SimpleNamespace(input=[named, IOFile("table.csv", rule=None), lambda wildcards: "a"])
    caption_where_made([target])
    assert target.input[0] is named and named == "figure.png" and is_flagged(named, "ensure")
    assert not is_flagged(named, "report") and is_flagged(made, "report")
