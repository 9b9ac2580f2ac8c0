"""``python -m nucleation``, and the command ``nucleation``."""

import os
import sys

from .installed import ONE_CORE, require_own


def start() -> None:
    """Run the command line of this process and end it with its exit code."""
    os.environ |= dict.fromkeys(ONE_CORE, "1")
    try:
        require_own()
    except ImportError as error:
        sys.exit(f"Error: {error}")
    from .commands import run

    sys.exit(run())


if __name__ == "__main__":
    start()
