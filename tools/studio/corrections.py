"""Blends with something wrong, and how each was put right in the studio."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from tools.studio.designer import Designer


class Correction(NamedTuple):
    """A blend, what is wrong with it, and what a designer does about it."""

    a: str  # of docs/studio
    b: str
    wrong: str
    done: str
    steps: Callable[[Designer], None]

    @property
    def files(self) -> tuple[str, str]:
        """The names of both drawings."""
        return f"{self.a}.svg", f"{self.b}.svg"

    @property
    def name(self) -> str:
        """What its picture is called."""
        return f"{self.a}-{self.b}"


def _front_cloud(designer: Designer) -> None:
    designer.pair((18.0, 28.0), (18.0, 12.0))


def _car(designer: Designer) -> None:
    designer.pair((30.0, 25.0), (33.0, 20.0))  # the body becomes the wall with windows
    designer.pair((25.0, 19.0), (16.0, 18.0))  # the window behind becomes the long one
    designer.pair((18.0, 19.0), (1.0, 19.0))  # and the one in front the windscreen


def _disc(designer: Designer) -> None:
    designer.pair((16.0, 24.0), (19.0, 26.0))


def _split(designer: Designer) -> None:
    designer.choose("--unmatched split")


def _drip(designer: Designer) -> None:
    designer.pin((110.0, 216.0), (113.0, 168.0))
    designer.pin((125.0, 216.0), (132.0, 168.0))


CORRECTIONS = (
    Correction(
        "clouds",
        "rain",
        "The cloud behind becomes the rain cloud, because it lies higher, and the one in front shrinks to nothing.",
        "Click the cloud in front, then the rain cloud.",
        _front_cloud,
    ),
    Correction(
        "car",
        "bus",
        "The upper half of the bus grows over the roof of the car, and the windows sink into the wheel arches.",
        "Click the body of the car, then the wall of the bus; the rear window, then the long window; and the front "
        "window, then the windscreen.",
        _car,
    ),
    Correction(
        "sun",
        "moon",
        "The rays become the moon, and the face shrinks and slides out of it.",
        "Click the disc of the sun, then the moon.",
        _disc,
    ),
    Correction(
        "run",
        "walk",
        "In B the leg behind and the arm in front are separate parts, so they grow from points, while those of A "
        "shrink away.",
        "From the row of other blends, choose the one in which the outline is cut for them.",
        _split,
    ),
    Correction(
        "elephant",
        "bear",
        "The head shrinks to crumbs, and the gap at the neck closes.",
        "Make the same choice. Then the bear's body is cut, and the elephant's head becomes the bear's.",
        _split,
    ),
    Correction(
        "cloud",
        "cloud-rain",
        "The whole base bulges into the drop that hangs from it.",
        "Set two pins: drag two points of the base, a drop's width apart, to where the drop begins.",
        _drip,
    ),
)
