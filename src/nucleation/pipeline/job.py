"""What every job of the workflow does: find its result in a store, or make it and put it there.

    python -m nucleation.pipeline.job RECIPE RULE THREADS LOG

The recipe says what to make (:mod:`.recipes`). Nothing heavy is loaded before the store was asked.
A job that Snakemake was forced to run makes its result once more and compares.
"""

import os
import sys
import time
from pathlib import Path

from .recipes import Recipe, read
from .store import others
from .views import show

FORCED = "NUCLEATION_FORCED"
"""Of the environment: the rules and files that Snakemake was forced to make, or ``*`` for all."""

ONE_CORE = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
"""Of the environment: a result is made on one core, as sums on several have another order.

Snakemake sets the first to the threads of the rule."""


def main(recipe_file: str, rule: str, threads: str, log: str) -> None:
    """Make the result of a recipe and show it; say in the log what happens.

    An error that the user can do something about is one line, in the log and on the terminal.
    """
    began, terminal = time.monotonic(), sys.stderr
    os.environ |= dict.fromkeys(ONE_CORE, "1")
    Path(log).parent.mkdir(parents=True, exist_ok=True)
    sys.stderr = Path(log).open("a", buffering=1, encoding="utf-8")  # noqa: SIM115  to the end
    recipe = read(recipe_file)
    try:
        if is_forced(rule, recipe) or not is_there(recipe):
            from .making import make

            make(recipe, rule, int(threads), is_forced(rule, recipe))
        show(recipe)
    except SystemExit as error:  # with the reason
        print(error, file=terminal)
        print(error, file=sys.stderr)
        sys.exit(1)
    print(f"done in {time.monotonic() - began:.1f} s", file=sys.stderr)


def is_there(recipe: Recipe) -> bool:
    """Whether a store has all that is needed; it is in the job's own store then."""
    store, elsewhere = recipe.store, others(strict=False)
    for one in recipe.needed:
        if store.note(one.key) is not None:
            continue
        source = store.take(one.key, elsewhere)
        if source is None:
            return False
        print(f"taken from {source}", file=sys.stderr)
    return True


def is_forced(rule: str, recipe: Recipe) -> bool:
    """Whether Snakemake was asked to make a result although it may be there."""
    named = os.environ.get(FORCED, "").split("\n")
    return not {"*", rule, *recipe.files}.isdisjoint(named)


if __name__ == "__main__":
    main(*sys.argv[1:])
