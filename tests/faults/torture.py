"""Many faults of random kinds at random moments: torture.py [COUNT [SEED]]; make torture.

Ends with status 1 if anything was lost. The seed repeats the choices, though not to the
microsecond the moments.
"""

import random
import shutil
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

from every import FAULTS
from harness import make_reference
from registry import CLEAR_ERROR, RECOVERED, disturb

LOST = "lost"
OUTCOMES = (RECOVERED, CLEAR_ERROR, LOST)


def main(count: int, seed: str) -> int:
    """Let faults happen and print a table of how they ended; the number of losses."""
    print(f"{count} faults, SEED={seed}", flush=True)
    counts: Counter[tuple[str, str]] = Counter()
    choice = random.Random(seed)
    with tempfile.TemporaryDirectory(prefix="torture-") as temporary:
        reference = make_reference(Path(temporary))
        names: list[str] = []
        while len(names) < count:  # each fault as often as any other
            names += choice.sample(sorted(FAULTS), len(FAULTS))
        for number, name in enumerate(names[:count], 1):
            directory, begin = Path(temporary, f"{number}-{name}"), time.monotonic()
            try:
                outcome = disturb(name, reference, directory, f"{seed} {number}")
            except Exception as loss:  # the others go on, whatever it was
                outcome = f"{LOST}: {loss!r}"
            print(f"{number:4}  {name:40} {time.monotonic() - begin:5.0f} s  {outcome}", flush=True)
            counts[FAULTS[name][0], outcome.split(":")[0]] += 1
            shutil.rmtree(directory)
            for path in Path(temporary).glob("*.output"):
                path.unlink()
    print(table(counts))
    return sum(number for (_, outcome), number in counts.items() if outcome == LOST)


def table(counts: Counter[tuple[str, str]]) -> str:
    """Kinds of faults in rows, how they ended in columns."""
    kinds = sorted({kind for kind, _ in counts})
    rows = [("fault", "count", *OUTCOMES)]
    for kind in [*kinds, "all"]:
        numbers = [
            sum(n for (k, o), n in counts.items() if kind in (k, "all") and o == outcome)
            for outcome in OUTCOMES
        ]
        rows.append((kind, sum(numbers), *numbers))
    return "\n".join(f"{row[0]:40}" + "".join(f"{text!s:>13}" for text in row[1:]) for row in rows)


if __name__ == "__main__":
    amount = int(sys.argv[1]) if len(sys.argv) > 1 else 200
    random_seed = sys.argv[2] if len(sys.argv) > 2 else str(random.randrange(10**6))
    sys.exit(1 if main(amount, random_seed) else 0)
