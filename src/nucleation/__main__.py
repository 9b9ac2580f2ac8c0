"""``python -m nucleation``, and the command ``nucleation``."""

import sys

from .commands import run


def start() -> None:
    """Run the command line of this process and end it with its exit code."""
    sys.exit(run())


if __name__ == "__main__":
    start()
