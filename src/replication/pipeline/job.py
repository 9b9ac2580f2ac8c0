"""A job of the workflow: take the result from a store, or make it and put it there.

    python -P -m replication.pipeline.job RECIPE RULE THREADS LOG

No heavy library is loaded before the stores were searched. If Snakemake was forced to run the job,
the result is made again and compared with the stored one.
"""

import contextlib
import gc
import logging
import os
import sys
import time
from pathlib import Path

from nucleation.installed import ONE_CORE

from . import LOGGER, PROGRESS
from .recipes import read
from .store import Store, others

FORCED = "NUCLEATION_FORCED"
"""Environment variable with the rules and files that Snakemake must make again; ``*`` for all."""


def main(recipe_file: str, rule: str, threads: str, log: str) -> None:
    """Make the result of a recipe and show it; SystemExit if that fails, with the reason logged."""
    began = time.monotonic()
    os.environ |= dict.fromkeys(ONE_CORE, "1")
    Path(log).parent.mkdir(parents=True, exist_ok=True)
    terminal = logging.StreamHandler(sys.stderr)
    terminal.setLevel(PROGRESS)
    LOGGER.addHandler(terminal)
    with (
        Path(log).open("a", buffering=1, encoding="utf-8") as stream,
        contextlib.redirect_stderr(stream),
    ):
        try:
            recipe = read(recipe_file)
            named = os.environ.get(FORCED, "").split("\n")
            paths = set(map(os.path.abspath, named))
            forced = not {"*", rule}.isdisjoint(named)
            forced |= not paths.isdisjoint(map(os.path.abspath, recipe.files))
            store = Store(f"{recipe.results}/store")
            for source in recipe.obtained(store, others(strict=False)):
                LOGGER.info(f"taken from {source}")
            if forced or not recipe.is_in(store):
                gc.disable()  # until all is loaded: looking for garbage takes a tenth of the time
                from .making import make

                make(recipe, rule, store, int(threads), forced)
            recipe.show()
        except (SystemExit, KeyboardInterrupt) as error:  # with the reason
            LOGGER.error(error if error.args else f"{rule}: stopped by SIGINT")
            sys.exit(1)
        LOGGER.info(f"done in {time.monotonic() - began:.1f} s")


if __name__ == "__main__":
    main(*sys.argv[1:])
