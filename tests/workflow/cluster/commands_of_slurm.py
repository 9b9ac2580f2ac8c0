"""What the tests of the cluster do again and again."""

import subprocess
import time
from collections.abc import Callable


def output_of(*command: str) -> str:
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def wait_for(condition: Callable[[], object], seconds: float = 600.0) -> None:
    """Look some times a second until a condition holds."""
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, f"not within {seconds:g} s"
        time.sleep(0.2)
