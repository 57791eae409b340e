"""Run the command, and strike at one of the moments in which it changes files.

    python -m tools.faults.aimed MOMENT WHAT [ARGUMENT ...]

WHAT is a signal, which the process gets just before change number MOMENT, or the name of an error, which that change
meets instead. With `hang` it says so and waits to be killed, with `count` a dot is printed for each change. The changes
are counted by Python's audit events, so that the command has no part in this.
"""

from __future__ import annotations

import errno
import os
import signal
import sys
import time

CHANGES = {"os.mkdir", "os.rename", "os.link", "os.remove", "os.rmdir", "ctypes.dlsym"}


def strike_at(moment: int, what: str) -> None:
    """Have this process struck, once, at a change that it makes from now on."""
    seen = 0

    def change() -> None:
        nonlocal seen
        seen += 1
        if what == "count":
            os.write(1, b".")
        elif seen == moment and what == "hang":
            os.write(1, b"here\n")
            time.sleep(3600)
        elif seen == moment and what.startswith("SIG"):
            os.kill(os.getpid(), getattr(signal, what))
        elif seen == moment:
            number = getattr(errno, what)
            raise OSError(number, os.strerror(number))

    def watch(event: str, arguments: tuple) -> None:
        if event in CHANGES or (event == "open" and arguments[1] == "x"):
            change()

    sync = os.fsync

    def fsync(handle: int) -> None:
        change()
        sync(handle)

    os.fsync = fsync
    sys.addaudithook(watch)


def main() -> None:
    moment, what = int(sys.argv[1]), sys.argv[2]
    sys.argv = ["shapeblend", *sys.argv[3:]]
    from shapeblend_cli.__main__ import main as command

    strike_at(moment, what)
    command()


if __name__ == "__main__":
    main()
