"""Settings for every way of calling pytest."""

import os

# Doctests are collected from the source of a kernel whose import gives the compiled module beside it.
os.environ.setdefault("PY_IGNORE_IMPORTMISMATCH", "1")


def pytest_addoption(parser):
    """Add the switch of `make golden`."""
    parser.addoption(
        "--update-golden", action="store_true", help="write the expected files of the golden tests anew"
    )
