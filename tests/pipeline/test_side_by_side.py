"""Work on several cores: the same values in the same order, and each end of a process is told."""

import os
import signal
import subprocess
import time

import pytest

from replication.pipeline.batches import side_by_side

NAMES = ["first", "second", "third", "fourth"]


@pytest.mark.parametrize("cores", [1, 2, 3, 8])
def test_values_come_in_order_whatever_the_cores(cores):
    def slow_at_first(number):
        time.sleep(0.05 * (3 - number))
        return number**2

    assert side_by_side(slow_at_first, NAMES, cores) == [0, 1, 4, 9]


def test_each_core_has_its_own_process():
    processes = side_by_side(lambda number: (time.sleep(0.1), os.getpid())[1], NAMES, 2)
    assert len(set(processes)) == 2 and os.getpid() not in processes
    assert side_by_side(lambda number: os.getpid(), NAMES, 1) == [os.getpid()] * 4


def test_a_killed_process_is_told_by_what_it_made(tmp_path):
    def work(number):
        if number == 1:
            os.kill(os.getpid(), signal.SIGKILL)
        time.sleep(0.2)
        (tmp_path / NAMES[number]).touch()

    with pytest.raises(SystemExit, match=r"second is not made: a process was killed"):
        side_by_side(work, NAMES, 2)
    assert "third" not in {path.name for path in tmp_path.iterdir()}, "no other one begins"


def test_an_error_ends_the_job_once_the_others_have_finished_what_they_have_begun(tmp_path):
    def work(number):
        if number == 0:
            time.sleep(0.1)
            raise ZeroDivisionError("of the first")
        time.sleep(0.2)
        (tmp_path / NAMES[number]).touch()

    with pytest.raises(SystemExit, match="ZeroDivisionError: of the first"):
        side_by_side(work, NAMES, 2)
    assert [path.name for path in tmp_path.iterdir()] == ["second"]


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT, signal.SIGHUP])
def test_a_signal_reaches_every_process(tmp_path, number):
    before = signal.getsignal(number)

    def work(part):
        def stop(*_):
            (tmp_path / NAMES[part]).touch()
            raise SystemExit(f"{NAMES[part]}: stopped")

        signal.signal(number, stop)
        time.sleep(20.0)

    subprocess.Popen(["sh", "-c", f"sleep 0.5; kill -{int(number)} {os.getpid()}"])
    with pytest.raises(
        SystemExit, match=r"^(first: stopped\nsecond|second: stopped\nfirst): stopped$"
    ):
        side_by_side(work, NAMES, 2)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["first", "second"]
    assert signal.getsignal(number) == before
