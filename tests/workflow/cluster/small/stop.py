"""Wait for SIGTERM and write for how long one lives on after it; end if that was written before."""

import signal
import sys
import time
from pathlib import Path

heard = Path(snakemake.params.heard)  # noqa: F821
if heard.exists():
    Path(snakemake.output[0]).write_text("ended\n")  # noqa: F821
    sys.exit()
received = []
signal.signal(signal.SIGTERM, lambda *_: received.append(time.monotonic()))
end = time.monotonic() + 120.0
while not received and time.monotonic() < end:
    time.sleep(0.1)
while received and time.monotonic() < received[0] + 3.0:  # as long as a large checkpoint takes
    time.sleep(0.1)
    heard.write_text(f"{time.monotonic() - received[0]:.1f}\n")
sys.exit("stopped")
