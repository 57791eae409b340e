"""Processes of `shapeblend_cli.system.processes` that are forked from this one, which saves them all imports.

They run the same program, and take orders and end as others do. How others start is for tests that do without this.
"""

import os
import signal
import subprocess
import sys
import threading
from types import SimpleNamespace

from shapeblend_cli.system.interrupts import STOPS


class Forked:
    """What `Child` uses of `subprocess.Popen`."""

    def __init__(self, command, **_):
        self._lock = threading.Lock()
        self.returncode = None
        (orders, ours), (from_it, answers) = os.pipe(), os.pipe()
        self.pid = os.fork()
        if self.pid == 0:
            _become(command[command.index("-c") :], orders, answers)
        os.close(orders)
        os.close(answers)
        self.stdin, self.stdout = os.fdopen(ours, "wb"), os.fdopen(from_it, "rb")

    def wait(self, how=0):
        with self._lock:
            if self.returncode is None and (ended := os.waitpid(self.pid, how))[0]:
                self.returncode = os.waitstatus_to_exitcode(ended[1])
        return self.returncode

    def poll(self):
        return None if self._lock.locked() else self.wait(os.WNOHANG)

    def kill(self, number=signal.SIGKILL):
        if self.poll() is None:
            os.kill(self.pid, number)

    def terminate(self):
        self.kill(signal.SIGTERM)


def _become(arguments, orders, answers):
    """Be the process of these arguments of Python, with nothing open that is of the other."""
    status = 1
    try:
        os.setsid()
        signal.set_wakeup_fd(-1)
        for number in STOPS:
            signal.signal(number, signal.SIG_DFL)
        os.dup2(orders, 0)
        os.dup2(answers, 1)
        os.closerange(3, os.sysconf("SC_OPEN_MAX"))
        sys.stdin = sys.stdout = sys.stderr = open(os.devnull, "r+")
        _, program, *sys.argv[1:] = arguments
        exec(program, {})
    except SystemExit as end:
        status = end.code
    finally:
        os._exit(status)


SUBPROCESS = SimpleNamespace(Popen=Forked, PIPE=subprocess.PIPE, DEVNULL=subprocess.DEVNULL)
