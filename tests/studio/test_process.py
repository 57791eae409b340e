"""The process of a studio, which is stopped and started again."""

import gc
from pathlib import Path

import pytest

from shapeblend_cli.rows.project import Project
from shapeblend_cli.studio.order import Order
from shapeblend_cli.studio.process import Failed, Process
from tests.support.drawings import LEAF, svg


def test_a_process_that_is_stopped_while_it_does_nothing_leaves_nothing_open():
    """Python warns of files that were left open, and warnings are errors here."""
    process = Process()
    try:
        child = process._started()
        process.stop("nobody waits")
        child._process.wait()
        with pytest.raises(Failed, match="NoneType"):
            process.ask(None, 60, 2000)
    finally:
        process.close()
        del process, child
        gc.collect()


def test_a_blend_that_takes_too_much_memory_is_stopped_and_the_next_one_is_made(here):
    crowd = "".join(f"M{k} 0h.5v.5z" for k in range(300))
    Path("a.svg").write_text(svg(crowd), "utf-8")
    Path("b.svg").write_text(svg(LEAF), "utf-8")
    order = Order("blend", Project(("a.svg", "b.svg"), {}), {})
    process = Process()
    try:
        with pytest.raises(
            Failed, match="it took more than 20 MB of memory, and was stopped; simpler drawings"
        ):
            process.ask(order, 60, 20)
        assert process.ask(order, 60, 2000)["pairs"]
    finally:
        process.close()
