"""Blend made-up and damaged drawings with random options for a while: each run must work, or end with an error of ours.

    python -m tools.fuzz_blend [SECONDS] [--start N] [--count N]
    python -m tools.fuzz_blend --case N

Every case, two files and a command line, is made from its number alone. One fails if it raises anything, warns, prints
what is no line of ours, or writes what is not finite. Its files go to `out/fuzz` under its number.
"""

from __future__ import annotations

import argparse
import io
import json
import os
import random
import re
import shutil
import sys
import tempfile
import time
import traceback
import warnings
from collections import Counter
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path
from xml.etree import ElementTree

from shapeblend_cli.cli import run
from shapeblend_cli.options.settings import ReadOptions, Settings
from shapeblend_cli.options.types import FLAG
from shapeblend_cli.outputs.options import OutputOptions
from tools import fuzz_reader

ROOT = Path(__file__).parents[1]
FAILED = ROOT / "out" / "fuzz"

SECONDS = "30"
"""Longer runs are stopped and counted."""

VALUES = (
    "0 1 2 3 7 12 40 0.01 0.3 0.5 1.5 1000 none auto 0,0 1,2 0,0:9,9 3,4:-1,5 5,5,3=2 0,0,99=0.1 0=0 1=0 a=b 1,1:2,2 "
    "ease ease-in-out cubic-bezier(0.1,0.9,0.2,1) linear forever pingpong red transparent #123456 #a path"
).split()
FEW = {"frames": range(5), "vertices": (0, 3, 9, 24), "width": (1, 9, 24), "fps": (1, 5), "columns": (1, 3)}
OUTPUTS = ("out", "out", "x.svg", "x.png", "x.gif", "x.webp", "x.apng")
DATA, NUMBER = re.compile(rb' d="[^"]*"'), re.compile(rb"\d+(\.\d+)?")
NOT_FINITE = re.compile(rb"(?<![\w#.-])-?(nan|inf|infinity)(?![\w.-])", re.IGNORECASE)


def options(rng: random.Random) -> list[str]:
    """Return options with values that each of them can have; not all of them go together."""
    chosen = ["-f", "--timeout", SECONDS, "--vertices", str(rng.choice(FEW["vertices"]))]
    if rng.random() < 0.3:
        chosen += ["--report", "r.json"]
    if rng.random() < 0.1:
        chosen += ["--preview", "p.html"]
    emit = rng.choice(["frames"] * 7 + ["pair", "lottie", "avd"])
    chosen += ["-o", rng.choice(OUTPUTS)] if emit == "frames" else ["--emit", emit]
    fields = [field for record in (ReadOptions, Settings, OutputOptions) for field in record.options.values()]
    free = [field for field in fields if field.name not in ("output", "emit", "vertices")]
    for field in rng.sample(free, rng.choice([0, 1, 2, 4, 8])):
        flag = rng.choice(field.flags).split("/")
        if field.kind is FLAG:
            chosen.append(rng.choice(flag))
            continue
        values = FEW.get(field.name) or field.kind.choices or [v for v in VALUES if can_be(field.kind, v)]
        if values:
            chosen += [max(flag, key=len), str(rng.choice(values))]
    return chosen


def can_be(kind, value: str) -> bool:
    try:
        kind.parse(value)
    except ValueError:
        return False
    return True


def case(number: int, seeds: list[bytes]) -> tuple[list[bytes], list[str]]:
    """Return the two files and the options of that number."""
    rng = random.Random(f"blend {number}")
    files = []
    for k in range(2):
        if rng.random() < 0.6:
            files.append(drawing(rng))
        else:
            files.append(fuzz_reader.case(2 * number + k, seeds)[: 2**14])
    if rng.random() < 0.25:
        files[1] = edited(rng, files[0])
    return files, options(rng)


def edited(rng: random.Random, data: bytes) -> bytes:
    """Return a document that is made from another: with numbers of its paths changed, some to the one before."""
    last = b"0"

    def number(found: re.Match[bytes]) -> bytes:
        nonlocal last
        if (kind := rng.random()) < 0.1:
            return last
        last = found[0] if kind < 0.5 else b"%.6g" % (float(found[0]) * rng.uniform(0.8, 1.2))
        return last

    return DATA.sub(lambda found: NUMBER.sub(number, found[0]), data)


def drawing(rng: random.Random) -> bytes:
    """Return a document of a few paths, most of which are fit to be blended."""
    paint = (
        "",
        ' fill="red"',
        ' fill="none" stroke="blue"',
        ' fill-rule="evenodd" stroke="red"',
        ' opacity=".5"',
    )
    size = rng.choice([1.0, 24.0, 24.0, 1000.0, 1e-6, 1e6])
    paths = []
    for _ in range(rng.choice([1, 1, 1, 2, 3, 6])):
        points = [f"{rng.uniform(0, size):.6g} {rng.uniform(0, size):.6g}" for _ in range(13)]
        d = "M" + points[0]
        for k in range(rng.randrange(1, 12)):
            d += rng.choice(
                [f"L{points[k + 1]}", f"L{points[k]}", f"Q{points[k]} {points[k + 1]}", f"T{points[k]}"]
            )
            if rng.random() < 0.1:
                d += "z" + rng.choice(["", f"M{points[0]}", f"m{points[k]}"])
        paths.append(
            f'<path d="{d}{rng.choice(["z", "z", ""])}"{rng.choice(paint)} id="{rng.choice("abc")}"/>'
        )
    box = rng.choice([f' viewBox="0 0 {size:g} {size:g}"', ""])
    return f'<svg xmlns="http://www.w3.org/2000/svg"{box}>{"".join(paths)}</svg>'.encode()


def complaint(files: list[bytes], arguments: list[str]) -> tuple[str | None, str]:
    """Return what is wrong with a run, None if nothing, and how it ended; its files are in the working folder."""
    for name in os.listdir():
        shutil.rmtree(name) if os.path.isdir(name) else os.remove(name)
    for name, data in zip(("a.svg", "b.svg"), files, strict=True):
        Path(name).write_bytes(data)
    said = io.StringIO()
    try:
        with warnings.catch_warnings(), redirect_stderr(said), redirect_stdout(io.StringIO()):
            warnings.simplefilter("error")
            status = run(["a.svg", "b.svg", *arguments])
    except BaseException as error:
        if isinstance(error, KeyboardInterrupt):
            raise
        return traceback.format_exc(limit=-6), "failed"
    lines = said.getvalue().splitlines()
    if not all(line.startswith("shapeblend: ") and line.isprintable() for line in lines):
        return f"printed {said.getvalue()!r}", "failed"
    if status:
        if any("stopped after" in line for line in lines):
            return None, "stopped"
        return (None if len(lines) else "an error without a line"), ("refused", "usage")[status - 1]
    for path in Path().rglob("*"):
        if path.suffix in (".svg", ".json", ".xml") and path.name not in ("a.svg", "b.svg"):
            data = path.read_bytes()
            if found := NOT_FINITE.search(data):
                return f"{path}: {data[max(0, found.start() - 60) : found.end() + 20]!r}", "failed"
            try:
                json.loads(data) if path.suffix == ".json" else ElementTree.fromstring(data)
            except (ValueError, ElementTree.ParseError) as error:
                return f"{path}: {error}", "failed"
    return None, "done"


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("seconds", nargs="?", type=float, default=60.0)
    parser.add_argument("--start", type=int, default=0, help="number of the first case")
    parser.add_argument("--count", type=int, default=10**9, help="how many cases at most")
    parser.add_argument("--case", type=int, help="run the case of one number, and say what it is")
    arguments = parser.parse_args()
    seeds = fuzz_reader.seeds(fuzz_reader.SEEDS)
    numbers = range(arguments.start, arguments.start + arguments.count)
    if arguments.case is not None:
        numbers = range(arguments.case, arguments.case + 1)
        print(*case(arguments.case, seeds)[1])
    ends: Counter[str] = Counter()
    until = time.monotonic() + arguments.seconds
    here = os.getcwd()
    folder = tempfile.mkdtemp(dir="/dev/shm" if os.path.isdir("/dev/shm") else None)
    os.chdir(folder)
    try:
        for number in numbers:
            if time.monotonic() > until:
                break
            files, options = case(number, seeds)
            found, end = complaint(files, options)
            ends[end] += 1
            if end == "stopped":
                print(
                    f"stopped after {SECONDS} s: {sys.executable} -m tools.fuzz_blend --case {number}",
                    flush=True,
                )
            if found:
                FAILED.mkdir(parents=True, exist_ok=True)
                for name, data in zip("ab", files, strict=True):
                    (FAILED / f"blend-{number}-{name}.svg").write_bytes(data)
                print(f"{found}\nagain: {sys.executable} -m tools.fuzz_blend --case {number}", flush=True)
    finally:
        os.chdir(here)
        shutil.rmtree(folder)
    total = sum(ends.values())
    print(f"{total} blends: {', '.join(f'{n} {end}' for end, n in ends.most_common())}; the next run: --start "
          f"{arguments.start + total}")  # fmt: skip
    return 1 if ends["failed"] else 0


if __name__ == "__main__":
    sys.exit(main())
