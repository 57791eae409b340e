"""``python -m shapeblend_cli`` and the ``shapeblend`` command."""

from __future__ import annotations

import gc
import sys

gc.disable()  # one short run; looking for garbage while modules load costs a tenth of the start

from shapeblend_cli.cli import run  # noqa: E402


def main() -> None:
    """Run the command line and leave with its exit status."""
    sys.exit(run(sys.argv[1:]))


if __name__ == "__main__":
    main()
