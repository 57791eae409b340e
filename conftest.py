"""Settings for every way of calling pytest."""

import os

# Doctests are collected from the source of a kernel whose import gives the compiled module beside it.
os.environ.setdefault("PY_IGNORE_IMPORTMISMATCH", "1")
