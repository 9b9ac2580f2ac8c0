"""Wait for SIGTERM and write when it came, and later that one lived on; end if it came before."""

import signal
import sys
import time
from pathlib import Path

began = time.monotonic()
heard = Path(snakemake.params.heard)  # noqa: F821
if heard.exists():
    Path(snakemake.output[0]).write_text("ended\n")  # noqa: F821
    sys.exit()
received = []
signal.signal(signal.SIGTERM, lambda *_: received.append(True))
while not received:  # the time limit ends it at the latest
    time.sleep(0.1)
text = f"{time.monotonic() - began:.1f} s: heard"
heard.write_text(f"{text}\n")
time.sleep(3.0)  # as long as a large checkpoint takes
heard.write_text(f"{text}, and lived on\n")
sys.exit("stopped")
