"""``python -m shapeblend_cli`` and the ``shapeblend`` command."""

import _signal  # type: ignore[import-not-found]  # `signal` loads other modules first
import os
import sys


def _stop(number: int, _: object) -> None:
    """End at once, in one line, while modules load."""
    os.write(2, b"shapeblend: interrupted; nothing was written\n")
    os._exit(128 + number)


if __name__ == "__main__" or os.path.basename(sys.argv[0]).startswith("shapeblend"):
    for each in ("SIGINT", "SIGTERM", "SIGHUP"):
        number = getattr(_signal, each, None)  # Windows has no SIGHUP
        if number is not None and _signal.getsignal(number) is not _signal.SIG_IGN:
            _signal.signal(number, _stop)

import gc  # noqa: E402
import time  # noqa: E402

# When the process was started, by the clock of the stages: until now it was at work all the time.
BEGAN = time.perf_counter() - time.process_time()

# Starting threads for large matrices, of which there are none, costs a sixth of the start; and with one thread, sums do
# not depend on the number of processors.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

gc.disable()  # one short run; looking for garbage while modules load costs a tenth of the start

from shapeblend_cli.cli import run_safely  # noqa: E402


def main() -> None:
    """Run the command line and leave with its exit status.

    Nothing is left to be done at the end of the interpreter, which could only fail there, with a traceback.
    """
    os._exit(run_safely(sys.argv[1:], BEGAN))


if __name__ == "__main__":
    main()
