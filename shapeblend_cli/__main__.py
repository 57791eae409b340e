"""``python -m shapeblend_cli`` and the ``shapeblend`` command."""

from __future__ import annotations

import gc
import os
import signal
import sys
import time

# When the process was started, by the clock of the stages: until now it was at work all the time.
BEGAN = time.perf_counter() - time.process_time()

# Starting threads for large matrices, of which there are none, costs a sixth of the start; and with one thread, sums do
# not depend on the number of processors.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

gc.disable()  # one short run; looking for garbage while modules load costs a tenth of the start


def _stop(number: int, _: object) -> None:
    """End at once, in one line, while modules load."""
    os.write(2, b"shapeblend: interrupted; nothing was written\n")
    os._exit(128 + number)


if __name__ == "__main__" or os.path.basename(sys.argv[0]).startswith("shapeblend"):
    for each in (signal.SIGINT, signal.SIGTERM):
        if signal.getsignal(each) is not signal.SIG_IGN:
            signal.signal(each, _stop)

from shapeblend_cli.cli import run_safely  # noqa: E402


def main() -> None:
    """Run the command line and leave with its exit status.

    Nothing is left to be done at the end of the interpreter, which could only fail there, with a traceback.
    """
    os._exit(run_safely(sys.argv[1:], BEGAN))


if __name__ == "__main__":
    main()
