"""Measure: which motion shapeblend chooses by itself, and whether that has a fault all the same."""

from __future__ import annotations

from typing import NamedTuple

from shapeblend_cli.motion.defects import CHECKED_TIMES, LEAST_AREA, LEAST_SECTION, MOST_AREA, MOST_REACH
from tools.quality import raw
from tools.quality.data import SETS, icon_pairs
from tools.quality.peers import shapeblend
from tools.quality.tables import Section, Table

LEAST, MOST, LIMB = (round(100 * share) for share in (LEAST_AREA, MOST_AREA, LEAST_SECTION))
TIMES, REACH = len(CHECKED_TIMES), f"{MOST_REACH:g}"

TEXT = f"""\
How many pairs get which motion by `--motion auto`, as the report has it (`motion`, `motion_because`). *With a fault*:
those for which no motion is without one, and the one with the least was taken. A fault is a crossing that neither
end has, at one of {TIMES} even times or at those of the frames, of a contour with itself or with another; an
area below {LEAST} % or above {MOST} % of the straight line between the ends'; a fifth of an outline that shrinks below
{LIMB} % of its length; a part that swings out to {REACH} times the distance that both ends have from their middle;
and of safe motion, nothing but round outlines half way."""


class Choice(NamedTuple):
    """What was chosen for a pair."""

    motion: str
    with_fault: bool


def choice(report: dict) -> Choice:
    """The motion of the one shape of an icon, from the report."""
    contour = report["pairs"][0]["contours"][0]
    motion, reasons = contour["motion"], contour["motion_because"].split("; ")
    return Choice(motion, any(reason.startswith(f"{motion}: ") for reason in reasons))


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
        header += [f"{SETS[name]}, {len(chosen)} pairs", "with a fault"]
    rows = []
    for motion in shapeblend.MOTIONS:
        row = [motion]
        for chosen in choices.values():
            faults = [one.with_fault for one in chosen if one.motion == motion]
            row += [str(len(faults)), str(sum(faults))]
        rows.append(row)
    return Section("Which motion", TEXT, Table(header, rows), [])
