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
        "Every file is as it was; exit status 1, and one line that says so. A signal that comes while files are moved, "
        "which takes milliseconds, waits: then all files are written, and the line says that.",
    ),
    (
        "A run is killed with SIGKILL, or the machine goes down",
        "Each target is the old one or the new one, whole; a folder of frames is one target. The next run that writes "
        "there removes what is left, whatever the numbers of the processes and the containers they ran in.",
    ),
    (
        "A run that writes several targets, such as frames and a report, is killed between two moves",
        "Each is whole; some may be new and others old. An error or a signal changes all of them or none.",
    ),
    (
        "Two runs have one target",
        "One wins whole. Without `--force` the other one fails and changes nothing, even if it began first; with it, "
        "the last one wins.",
    ),
    (
        "A folder of frames is there, and `--force` is given",
        "It is exchanged for a new one in one step. Other files in it move along. Frames of a longer run, "
        "`frame-NUMBER` files that the run does not write, stay too, and a line says so, with `--quiet` as well.",
    ),
    (
        "A file or a folder is replaced",
        "It keeps its mode and, where the system allows it, its owner and group.",
    ),
    (
        "The target is a symbolic link",
        "The link stays; the file or folder it leads to is replaced.",
    ),
    (
        "The target is a device, a named pipe or `/dev/stdout`",
        "It is written to and stays, with `--force` and without, after all files are in place.",
    ),
    (
        "Standard output is closed or full",
        "Exit status 1 if anything had to be printed there, and one line, which says whether files were written.",
    ),
    ("Standard error is closed or full", "Nothing comes of it."),
)

EXCEPTIONS = (
    "Some folders cannot be exchanged: the working folder of the run and what that lies in, a mount point, a folder "
    "with folders in it, one in a folder that may not be written to, one on a drive without links. Their frames are "
    "moved one by one. An error or a signal still puts all of them back. After SIGKILL in the middle of the moves old "
    "and new frames stand side by side, each whole, until the next run that writes there; it puts the old ones back, "
    "but none in place of a file that has changed since.",
    "Where the system has no `renameat2`, as only Linux has, a folder is exchanged in two steps. A run that is killed "
    "between them leaves no folder there; the next one puts the old one back.",
    "A folder that was exchanged is another folder: programs that had the old one open, such as one that watches it, "
    "have to open it anew.",
    "What keeps runs apart are the system's locks on folders (`flock`). Where there are none, as on Windows and on "
    "some network drives, two runs at once are not kept apart, except that without `--force` no single file is "
    "replaced, and `.shapeblend-*` folders that killed runs have left stay. So do those of another user. "
    "A run waits half a minute for a lock, and then does without.",
    "A signal that comes before Python has read the first line of this program ends it in Python's own way.",
)

MEANS = (
    "Moves are all steps of a run that change the file system. A signal or an error is aimed at each of them in "
    "turn by Python's audit events, of which the command knows nothing. After every kill the targets are compared "
    "with the old and the new ones byte by byte, and what the run said with what stands; then one further run has "
    "to succeed and to leave nothing else behind."
)


def document(counts: Counts) -> str:
    """Return the page."""
    rows = []
    for name in SIGNALS:
        rows.append((f"{name} at a random moment", str(counts.kills), "0"))
        rows.append((f"{name} at a move", str(counts.kills), "0"))
        rows.append((f"{name} while the program loads its modules", str(counts.kills // 4), "0"))
    rows.append(("an error of the disk at a move", str(counts.errors), "0"))
    rows.append(("two runs at once on one target", str(counts.meetings), "0"))
    times = "not on this machine" if counts.namespaces is None else str(counts.namespaces)
    rows.append(("process 1 of a PID namespace killed, and run again in another", times, "0"))
    parts = [
        "# What stands when something goes wrong",
        "Written by `make faults`, which runs everything in the last table and stops at the first promise that is not "
        "kept. `tests/cli/test_writing.py` has a case or two of each.",
        "## What is promised",
        Table(("if", "then"), PROMISES).markdown().rstrip("\n"),
        "## Where less is promised",
        *EXCEPTIONS,
        "## How it is tested",
        Table(("what", "times", "promises broken"), rows).markdown().rstrip("\n"),
        f"Targets of the kills: {', '.join(TARGETS)}. {MEANS}",
    ]
    folded = [part if part.startswith("|") else textwrap.fill(part, 120) for part in parts]
    return "\n\n".join(folded) + "\n"
