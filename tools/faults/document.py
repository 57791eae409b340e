"""What docs/reliability.md says."""

from __future__ import annotations

import textwrap
from typing import NamedTuple

from tools.faults.runs import ROOT, SIGNALS, TARGETS
from tools.quality.tables import Table

DOCUMENT = ROOT / "docs" / "reliability.md"


class Counts(NamedTuple):
    """How often promises were put to the test, and kept."""

    namespaces: int | None  # None where the machine has none
    errors: int
    kills: int  # with each signal, and at each kind of moments
    meetings: int


PROMISES = (
    (
        "A run fails, or is stopped by Ctrl-C, SIGTERM, SIGHUP or `--timeout`",
        "Every file is as it was. The exit status is 1, and one line says so. A signal that comes while files are "
        "being moved, which takes milliseconds, has to wait: then all files are written, and the line says that.",
    ),
    (
        "A run is killed with SIGKILL, or the machine goes down",
        "Each target is complete, either the old one or the new one. A folder of frames is one target. The next run "
        "that writes there removes what the killed run left, whatever the process numbers and containers of the two.",
    ),
    (
        "A run that writes several targets, such as frames and a report, is killed between two moves",
        "Each is complete, but some may be new and others old. An error or a signal changes all of them or none.",
    ),
    (
        "Two runs have the same target",
        "The result is that of one of them, complete. Without `--force` the other one fails and changes nothing, "
        "even if it began first. With `--force`, the last one wins.",
    ),
    (
        "A folder of frames exists, and `--force` is given",
        "It is exchanged for a new one in one step. Other files in it are kept. So are frames of a longer run, that "
        "is, `frame-NUMBER` files that this run does not write, and a line says so, even with `--quiet`.",
    ),
    (
        "A file or a folder is replaced",
        "It keeps its mode and, where the system allows it, its owner and group.",
    ),
    (
        "The target is a symbolic link",
        "The link stays, and the file or folder that it points to is replaced.",
    ),
    (
        "The target is a device, a named pipe or `/dev/stdout`",
        "It is written to, not replaced, with or without `--force`. This happens after all files are in place.",
    ),
    (
        "Standard output is closed or full",
        "If anything had to be printed there, the exit status is 1, and one line says whether files were written.",
    ),
    ("Standard error is closed or full", "It makes no difference."),
)

EXCEPTIONS = (
    "Some folders cannot be exchanged: the working folder of the run and the folders that it lies in, a mount point, a "
    "folder with folders in it, a folder in one that may not be written to, and a folder on a drive without links. "
    "Their frames are moved one by one. An error or a signal still puts all of them back. After SIGKILL in the middle "
    "of the moves, old and new frames are mixed, each of them complete, until the next run that writes there. That run "
    "puts the old ones back, but does not replace a file that has changed since.",
    "Only Linux has `renameat2`. On other systems a folder is exchanged in two steps. A run that is killed between "
    "them leaves no folder there, and the next run puts the old one back.",
    "An exchanged folder is a different folder. Programs that had the old one open, for example to watch it, have to "
    "open it again.",
    "Runs are kept apart by the system's locks on folders (`flock`). Windows and some network drives have none. There, "
    "two runs at once are not kept apart, except that without `--force` no single file is replaced. The "
    "`.shapeblend-*` folders that killed runs leave there are not removed. Neither are those of another user. A run "
    "waits half a minute for a lock, and then does without it.",
    "A signal that comes before Python has read the first line of the program ends it in Python's own way.",
)

MEANS = (
    "A move is any step of a run that changes the file system. Python's audit events, of which the command knows "
    "nothing, aim a signal or an error at each move in turn. After every kill, the targets are compared byte by byte "
    "with the old and the new ones, and what the run said is compared with what is there. Then one further run has to "
    "succeed and to leave nothing else behind."
)


def document(counts: Counts) -> str:
    """Return the page."""
    rows = []
    for name in SIGNALS:
        rows.append((f"{name} at a random moment", str(counts.kills), "0"))
        rows.append((f"{name} at a move", str(counts.kills), "0"))
        rows.append((f"{name} while the program loads its modules", str(counts.kills // 4), "0"))
    rows.append(("a disk error at a move", str(counts.errors), "0"))
    rows.append(("two runs at once on one target", str(counts.meetings), "0"))
    times = "not on this machine" if counts.namespaces is None else str(counts.namespaces)
    rows.append(("process 1 of a PID namespace killed, and run again in another", times, "0"))
    parts = [
        "# What happens when something goes wrong",
        "Written by `make faults`, which runs everything in the last table and stops at the first promise that is "
        "broken. `tests/cli/test_writing.py` has a case or two of each.",
        "## What is promised",
        Table(("if", "then"), PROMISES).markdown().rstrip("\n"),
        "## Where less is promised",
        *EXCEPTIONS,
        "## How it is tested",
        Table(("what", "times", "promises broken"), rows).markdown().rstrip("\n"),
        f"The targets of the kills: {', '.join(TARGETS)}. {MEANS}",
    ]
    folded = [part if part.startswith("|") else textwrap.fill(part, 120) for part in parts]
    return "\n\n".join(folded) + "\n"
