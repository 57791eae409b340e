"""Blend made-up drawings near the limits, each run in a process of its own, and say what they cost.

    python -m tools.fuzz_limits [COUNT] [--start N]
    python -m tools.fuzz_limits --case N

Every case, two drawings, is made from its number alone: many equal parts, deep nests, long gradients, clip paths and
zigzags, more of them small than large. A run is to end within 10 seconds of CPU and 500 megabytes in 99 of 100 cases,
and the others within 60 seconds; or it is to be refused in one line. Cases that cost more are listed.
"""

from __future__ import annotations

import argparse
import os
import random
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path
from typing import NamedTuple

SECONDS, MEGABYTES, MOST_SECONDS = 10.0, 500.0, 60.0


def squares(rng: random.Random, count: int) -> str:
    """Return squares, many of them in one place, or in rows."""
    step, side = rng.choice([0.0, 0.0, 3.0]), rng.uniform(1.0, 40.0)
    row = int(count**0.5) + 1
    return path(
        "".join(
            f"M{step * (k % row):g} {step * (k // row):g}h{side:g}v{side:g}h-{side:g}z" for k in range(count)
        )
    )


def nest(rng: random.Random, count: int) -> str:
    """Return squares inside each other."""
    size = rng.uniform(40.0, 100.0) / count
    corners = ((50.0 - size * k / 2, size * k) for k in range(count, 0, -1))
    return path("".join(f"M{x:g} {x:g}h{s:g}v{s:g}h-{s:g}z" for x, s in corners), 'fill-rule="evenodd"')


def gradient(rng: random.Random, count: int) -> str:
    """Return a rectangle with a gradient of many stops."""
    stops = "".join(
        f'<stop offset="{k / count:g}" stop-color="#{rng.randrange(1 << 24):06x}"/>'
        for k in range(10 * count)
    )
    shape = path(f"M{rng.uniform(0, 30):g} 10h50v50h-50z", 'fill="url(#g)"')
    return f'<linearGradient id="g">{stops}</linearGradient>{shape}'


def clip(rng: random.Random, count: int) -> str:
    """Return a rectangle seen through many circles."""
    circles = "".join(
        f'<circle cx="{rng.uniform(0, 100):.3g}" cy="{rng.uniform(0, 100):.3g}" r="{rng.uniform(0.5, 4):.3g}"/>'
        for _ in range(count)
    )
    return f'<clipPath id="c">{circles}</clipPath>' + path("M5 5h90v90h-90z", 'clip-path="url(#c)"')


def zigzag(rng: random.Random, count: int) -> str:
    """Return a zigzag of many points, as a line or as a shape."""
    count *= 10
    points = " ".join(
        f"{100 * k / count:g},{50 + 20 * (k % 2) + rng.uniform(-5, 5):.4g}" for k in range(count)
    )
    return (
        path(f"M{points}", 'fill="none" stroke="#000"') if rng.random() < 0.5 else path(f"M{points} 50,99z")
    )


def dots(rng: random.Random, count: int) -> str:
    """Return small polygons everywhere."""
    return path("".join(f"M{rng.uniform(0, 99):.4g} {rng.uniform(0, 99):.4g}h1l-.5 1z" for _ in range(count)))


KINDS = (squares, nest, gradient, clip, zigzag, dots)


def path(data: str, more: str = "") -> str:
    return f'<path d="{data}" {more}/>'


def case(number: int) -> tuple[str, list[str]]:
    """Return the name of a case and its two drawings, most of which are of one kind."""
    rng = random.Random(f"limits {number}")
    kinds = [rng.choice(KINDS)] * 2
    if rng.random() < 0.2:
        kinds[1] = rng.choice(KINDS)
    counts = [round(2000 ** rng.uniform(0.1, 1.0)) for _ in kinds]
    if rng.random() < 0.5:
        counts[1] = counts[0]
    drawings = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">{kind(rng, count)}</svg>'
        for kind, count in zip(kinds, counts, strict=True)
    ]
    return " and ".join(
        f"{count} {kind.__name__}" for kind, count in zip(kinds, counts, strict=True)
    ), drawings


class Cost(NamedTuple):
    """What a run took, and how it ended."""

    seconds: float
    megabytes: float
    status: int
    said: str

    @property
    def end(self) -> str:
        """The name of the kind of end."""
        lines = len(self.said.splitlines())
        if self.status not in (0, 1) or (self.status == 1) != (lines == 1) or "this is a bug" in self.said:
            return "broken"
        if "stopped" in self.said:
            return "stopped"
        if self.status == 1:
            return "refused"
        return "cheap" if self.seconds <= SECONDS and self.megabytes <= MEGABYTES else "dear"


def cost(drawings: list[str], where: Path) -> Cost:
    """Blend two drawings in a process of its own."""
    for name, text in zip("ab", drawings, strict=True):
        (where / f"{name}.svg").write_text(text)
    limits = ["--timeout", str(4 * MOST_SECONDS)]
    command = [sys.executable, "-m", "shapeblend_cli", "a.svg", "b.svg", "-o", "out.svg", "-f", "-q", *limits]
    process = subprocess.Popen(
        command, cwd=where, stdout=subprocess.DEVNULL, stderr=(where / "said").open("wb")
    )
    _, status, used = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    said = (where / "said").read_text("utf-8", "replace")
    return Cost(used.ru_utime + used.ru_stime, used.ru_maxrss / 1000, process.returncode, said)


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("count", nargs="?", type=int, default=1000)
    parser.add_argument("--start", type=int, default=0, help="number of the first case")
    parser.add_argument("--case", type=int, help="run the case of one number")
    arguments = parser.parse_args()
    numbers = range(arguments.start, arguments.start + arguments.count)
    if arguments.case is not None:
        numbers = range(arguments.case, arguments.case + 1)
    ends: Counter[str] = Counter()
    with tempfile.TemporaryDirectory() as folder:
        for number in numbers:
            name, drawings = case(number)
            found = cost(drawings, Path(folder))
            ends[found.end] += 1
            if found.end != "cheap" or arguments.case is not None:
                text = f"{found.end}: {found.seconds:.1f} s, {found.megabytes:.0f} MB {found.said.strip()}"
                print(f"case {number}, {name}: {text}", flush=True)
    count = sum(ends.values())
    print(f"{count} cases: {', '.join(f'{ends[end]} {end}' for end in sorted(ends))}")
    return int(ends["broken"] > 0 or ends["stopped"] > 0 or ends["dear"] > 0.01 * count)


if __name__ == "__main__":
    sys.exit(main())
