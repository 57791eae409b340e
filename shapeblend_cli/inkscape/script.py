"""The extension that Inkscape runs: it hands everything on to the command ``shapeblend``.

``shapeblend inkscape install`` copies this file, with the command in place of None. It imports nothing but the standard
library, as any Python that Inkscape brings must do.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys

COMMAND: list[str] | None = None
MISSING = (
    "The command shapeblend was not found. Install it, then type in a terminal: shapeblend inkscape install"
)
OWN = ("what", "tab", "selected-nodes")  # arguments that are not for the command


def command() -> list[str] | None:
    """Return the words that call the command, or None."""
    if COMMAND and os.path.exists(COMMAND[0]):
        return list(COMMAND)
    found = shutil.which("shapeblend")
    return [found] if found else None


def arguments(given: list[str]) -> list[str]:
    """Return the arguments of the command for those that Inkscape gives: parameters, ids, and a file."""
    words, what = [], "blend"
    for word in given:
        name, equals, value = word.partition("=")
        if not (name.startswith("--") and equals):
            words.append(word)
        elif name[2:] == "what":
            what = value
        elif value == "true":
            words.append(name)
        elif name[2:] not in OWN and value not in ("", "false"):
            words.append(word)
    return ["inkscape", what, *words]


def main() -> int:
    """Call the command, and hand its output to Inkscape."""
    called = command()
    if called is None:
        sys.stderr.write(MISSING + "\n")
        return 1
    # Python and libraries that Inkscape brings are not for others.
    hidden = ("PYTHONHOME", "PYTHONPATH", "LD_LIBRARY_PATH", "GI_TYPELIB_PATH")
    environment = {name: value for name, value in os.environ.items() if name not in hidden}
    try:
        done = subprocess.run(called + arguments(sys.argv[1:]), capture_output=True, env=environment)
    except OSError:
        sys.stderr.write(MISSING + "\n")
        return 1
    errors = done.stderr.decode("utf-8", "replace")
    if b"No module named shapeblend_cli" in done.stderr:
        errors = MISSING + "\n"
    sys.stderr.write(errors)
    sys.stdout.buffer.write(done.stdout)
    return done.returncode


if __name__ == "__main__":
    sys.exit(main())
