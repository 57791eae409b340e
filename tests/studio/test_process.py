"""The process of a studio, which is stopped and started again."""

import gc

import pytest

from shapeblend_cli.studio.process import Failed, Process


def test_a_process_that_is_stopped_while_it_does_nothing_leaves_nothing_open():
    """Python warns of files that were left open, and warnings are errors here."""
    process = Process()
    try:
        child = process._started()
        process.stop("nobody waits")
        child._process.wait()
        with pytest.raises(Failed, match="NoneType"):
            process.ask(None, 60)
    finally:
        process.close()
        del process, child
        gc.collect()
