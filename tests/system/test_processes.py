"""Processes that are asked to do something: they end with whoever asks."""

import os
import signal
import subprocess
import sys
import time

import pytest

from shapeblend_cli.system.processes import Parent
from tests.support.commands import wait_until

ASKING = """
import sys
from shapeblend_cli.system.processes import Child
child = Child("tests.system.test_processes")
assert child.becomes_ready()
print(child._process.pid, flush=True)
child.ask(sys.argv[1])
"""


def main():
    """Be at work for a minute, and say so."""
    parent = Parent()
    for order in parent.orders():
        if order == "deaf":
            signal.signal(signal.SIGTERM, signal.SIG_IGN)
        with open("at-work", "w") as stream:
            stream.write(order)
        time.sleep(60)


def is_there(number):
    try:
        os.kill(number, 0)
        with open(f"/proc/{number}/stat") as stream:
            return stream.read().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


@pytest.mark.skipif(not os.path.exists("/proc/self/stat"), reason="no /proc here")
@pytest.mark.parametrize("order", ["listen", "deaf"])
def test_a_process_at_work_ends_when_its_parent_is_killed(here, order):
    asking = subprocess.Popen([sys.executable, "-c", ASKING, order], stdout=subprocess.PIPE, text=True)
    number = int(asking.stdout.readline())
    try:
        wait_until((here / "at-work").exists)
        asking.kill()
        wait_until(lambda: not is_there(number))
    finally:
        asking.kill()
        asking.communicate()
        if is_there(number):
            os.kill(number, signal.SIGKILL)
