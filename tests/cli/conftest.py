"""Commands run in a folder of their own."""

import pytest

from shapeblend_cli.cli import run
from tests.support.commands import contents, write
from tests.support.drawings import BAR, LEAF, RING, svg


@pytest.fixture
def three(here):
    """A working folder with three drawings."""
    write(
        a=svg(BAR, attributes='fill="#ff0000"'),
        b=svg(LEAF, attributes='fill="#0000ff"'),
        c=svg(RING, attributes='fill-rule="evenodd"'),
    )
    return here


@pytest.fixture
def refused(here, capsys):
    """Run what fails with one line on standard error; nothing else is printed, and no file changes."""

    def check(arguments, status, words):
        before = contents()
        assert run(arguments) == status
        out, err = capsys.readouterr()
        (line,) = err.splitlines()
        assert line.startswith("shapeblend: ")
        assert words in line
        assert (out, contents()) == ("", before)
        return line

    return check
