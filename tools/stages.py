"""Measure what each stage of a blend takes in a warm process, beside other tools: `python -m tools.stages`.

A blend here is two drawings of one contour read, blended, and written as an animated SVG. Other tools get the same path
data and write `FRAMES` in-betweens. Times are of the processor; what a tool takes to start does not count, and node has
compiled what it runs often. All take turns, and multiples are of what flubber takes in the same turn: the clock of the
processor changes its speed.
"""

from __future__ import annotations

import sys
import tempfile
from functools import wraps
from importlib import import_module
from pathlib import Path
from statistics import median
from time import process_time
from typing import TYPE_CHECKING, Any

import shapeblend_cli
from tools.quality.data import icon_pairs
from tools.quality.peers import LIBRARIES, arc_length, flubber, ready
from tools.quality.times import theirs, written

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from tools.quality.data import Pair

FRAMES = 30
"""Number of in-betweens that other tools write."""

EVERY = 5
"""One pair in this many is measured."""

ROUNDS = 5
"""Number of turns; their median counts."""

MANY = 8
"""Number of times that a library blends all pairs in the longer of two runs of a turn; the shorter has one."""

STAGES = {
    "read": ("svg.reading.read", "read"),
    "flatten and place": ("blending.placing", "lay"),
    "look for lines": ("pens.drawings", "pen_drawing"),
    "choose a direction": ("wires.direction", "choose_direction"),
    "solve by symmetry": ("wires.symmetry", "solve_with_symmetry"),
    "solve on common cuts": ("wires.common_cuts", "solve_with_common_cuts"),
    "give both the same curves": ("interpolate.paths", "with_curves"),
    "judge straight paths": ("motion.choose", "judged_straight"),
    "judge other motions": ("motion.choose", "best_motion"),
    "draw": ("outputs.animated_svg", "render"),
    "write": ("system.write", "write_files"),
}
"""The function of each stage, by module; a stage in another counts with the outer one."""


class Stages:
    """Seconds by stage, of the functions of `STAGES` while they are watched."""

    def __init__(self) -> None:
        self.seconds = dict.fromkeys(STAGES, 0.0)
        self._inside = False

    def watch(self) -> None:
        """Put a watch on every stage."""
        for stage, (module, name) in STAGES.items():
            function = getattr(import_module(f"shapeblend_cli.{module}"), name)
            watched = self._watched(stage, function)
            for other in [one for one in sys.modules.values() if one.__name__.startswith("shapeblend_cli")]:
                for key, value in list(vars(other).items()):
                    if value is function:
                        setattr(other, key, watched)
                    elif isinstance(value, tuple) and function in value:
                        setattr(other, key, tuple(watched if one is function else one for one in value))

    def _watched(self, stage: str, function: Callable[..., Any]) -> Callable[..., Any]:
        @wraps(function)
        def timed(*values: Any, **options: Any) -> Any:
            if self._inside:
                return function(*values, **options)
            self._inside, began = True, process_time()
            try:
                return function(*values, **options)
            finally:
                self.seconds[stage] += process_time() - began
                self._inside = False

        return timed


class Ours:
    """Blends of pairs by shapeblend, whose drawings are in a folder."""

    def __init__(self, pairs: Sequence[Pair], folder: Path) -> None:
        self._drawings = [(folder / row["a"], folder / row["b"]) for row in written(pairs, folder)]
        self._target = folder / "moving.svg"
        self._stages = Stages()
        self._blend_all()
        self._stages.watch()

    def turn(self) -> dict[str, float]:
        """Blend all pairs; return the seconds of the stages of a blend, the rest and the whole, on average."""
        self._stages.seconds = dict.fromkeys(STAGES, 0.0)
        began = process_time()
        self._blend_all()
        whole = process_time() - began
        seconds = {
            **self._stages.seconds,
            "the rest": whole - sum(self._stages.seconds.values()),
            "a blend": whole,
        }
        return {name: taken / len(self._drawings) for name, taken in seconds.items()}

    def _blend_all(self) -> None:
        for a, b in self._drawings:
            shapeblend_cli.blend(a, b).save(self._target, force=True)


def others(pairs: Sequence[Pair], folder: Path) -> dict[str, float]:
    """Return the seconds of a blend by other tools, starting apart, on average over the pairs."""
    seconds = {}
    for library in LIBRARIES:
        run = theirs(library, [k / (FRAMES + 1) for k in range(1, FRAMES + 1)])
        once, often = (run([*pairs] * times, folder) for times in (1, 1 + MANY))
        seconds[library.name] = (often - once) / (MANY * len(pairs))
    began = process_time()
    arc_length.blends([*pairs])
    seconds[arc_length.NAME] = (process_time() - began) / len(pairs)
    return seconds


def main() -> None:
    if missing := ready():
        print(f"nothing to compare with: {missing}")
        return
    pairs = icon_pairs("single")[::EVERY]
    with tempfile.TemporaryDirectory() as folder:
        blends = Ours(pairs, Path(folder))
        turns = [{**blends.turn(), **others(pairs, Path(folder))} for _ in range(ROUNDS)]
    print(f"processor time of a blend in a warm process, mean of {len(pairs)} pairs of one contour")
    for name in turns[0]:
        taken = median(turn[name] for turn in turns)
        times = median(turn[name] / turn[flubber.NAME] for turn in turns)
        print(f"{name:28}{1000 * taken:8.2f} ms{times:8.2f} times flubber")


if __name__ == "__main__":
    main()
