"""Measure: which motion shapeblend chooses by itself, and whether that has a fault all the same."""

from __future__ import annotations

import statistics
from typing import NamedTuple

from tools.quality import raw
from tools.quality.data import SETS, icon_pairs
from tools.quality.peers import shapeblend
from tools.quality.tables import Section, Table

TEXT = """\
How many pairs get which motion by `--motion auto`, as the report has it (`motion`), and how wrong the judge finds the
in-betweens with it, in the median (`wrong`, 0 where it was not asked; [motion](motion.md) says what that adds up)."""


class Choice(NamedTuple):
    """What was chosen for a pair."""

    motion: str
    wrong: float


def choice(report: dict) -> Choice:
    """The motion of the one shape of an icon, from the report."""
    contour = report["pairs"][0]["contours"][0]
    judged = {one["name"]: one["wrong"] for one in contour["candidates"]}
    return Choice(contour["motion"], judged.get(contour["motion"], 0.0))


def measured() -> dict:
    """What is chosen for every pair of every set."""
    found = {}
    for name in SETS:
        pairs = icon_pairs(name)
        reports = [shapeblend.report(pair) for pair in pairs]
        choices = raw.columns(Choice, [report and choice(report) for report in reports])
        found[name] = {"pairs": [pair.id for pair in pairs], **choices}
    return found


def section(found: dict) -> Section:
    choices = {name: [one for one in raw.records(Choice, found[name]) if one] for name in SETS}
    header = ["motion"]
    for name, chosen in choices.items():
        header += [f"{SETS[name]}, {len(chosen)} pairs", "wrong"]
    rows = []
    for motion in shapeblend.MOTIONS:
        row = [motion]
        for chosen in choices.values():
            wrong = [one.wrong for one in chosen if one.motion == motion]
            row += [str(len(wrong)), f"{statistics.median(wrong):.3f}" if wrong else ""]
        rows.append(row)
    return Section("Which motion", TEXT, Table(header, rows), [])
