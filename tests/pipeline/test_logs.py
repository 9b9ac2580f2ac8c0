"""The last line of a job's log says how it ended."""

import re
import sys

import pytest

from nucleation.pipeline.logs import logged

STAMP = r"\d{4}-\d\d-\d\d \d\d:\d\d:\d\d"


def test_finished_job_says_so_in_its_last_line(tmp_path):
    path = tmp_path / "logs" / "run.log"
    before = sys.stderr
    with logged(path, "run-1") as log:
        assert sys.stderr is log
        print("45 % done", file=sys.stderr)
    assert sys.stderr is before
    first, said, last = path.read_text().splitlines()
    assert re.fullmatch(rf"{STAMP} run-1: begun by process \d+", first)
    assert said == "45 % done"
    assert re.fullmatch(rf"{STAMP} run-1: finished after [\d.]+ s", last)


@pytest.mark.parametrize(
    ("error", "end"),
    [
        (ValueError("no such height"), r"failed after [\d.]+ s, ValueError: no such height"),
        (KeyboardInterrupt(), r"failed after [\d.]+ s, KeyboardInterrupt: "),
        (SystemExit("stopped by SIGTERM"), r"stopped after [\d.]+ s, stopped by SIGTERM"),
        (SystemExit(0), r"finished after [\d.]+ s"),
    ],
)
def test_other_ends_are_named_and_go_on(tmp_path, error, end):
    path = tmp_path / "run.log"
    with pytest.raises(type(error)), logged(path, "run-1"):
        raise error
    assert re.fullmatch(rf"{STAMP} run-1: {end}", path.read_text().splitlines()[-1])


def test_attempts_follow_each_other(tmp_path):
    for _ in range(2):
        with logged(tmp_path / "run.log", "run-1"):
            pass
    assert (tmp_path / "run.log").read_text().count("finished") == 2


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="a device that is always full")
def test_full_disk_does_not_hide_the_reason():
    with pytest.raises(OSError, match="No space left"), logged("/dev/full", "run-1"):
        raise ValueError("what happened")
