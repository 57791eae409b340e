"""Feed the reader damaged and made-up files for a while: each must be read or refused, in little time and memory.

    python tools/fuzz_reader.py [SECONDS] [--seeds FOLDER ...] [--start N]
    python tools/fuzz_reader.py --case out/fuzz/123.svg

Every case is made from its number alone, so the same seeds give the same files. A case that fails is written to
`out/fuzz` under its number, and printed with the command that runs it again.
"""

from __future__ import annotations

import argparse
import gzip
import math
import random
import re
import resource
import signal
import sys
import time
import traceback
from contextlib import contextmanager
from pathlib import Path

import numpy as np

from shapeblend_cli.errors import InputError
from shapeblend_cli.job.report import inspection
from shapeblend_cli.svg.reading.read import read

ROOT = Path(__file__).parents[1]
FAILED = ROOT / "out" / "fuzz"
SEEDS = [ROOT / "tests" / "svg" / "reading" / "files", ROOT / "samples"]

MOST_SECONDS = 2.0
MOST_BYTES = 300 * 2**20

NUMBER = rb"[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?"
ATTRIBUTE = rb"\s[A-Za-z_:][\w:.-]*\s*=\s*(?:\"[^\"<]*\"|'[^'<]*')"
ODD_NUMBERS = (
    b"0 -0 1e9 -1e9 1e8 1e-9 1e-300 1e999 -1e999 nan inf 1e 1. .5 -.0 00 1e+5 0x10 99999999999999999999 "
    b"4294967296 -2147483648 50% 1em 3mm 1e5% 2147483647"
).split()
DICTIONARY = [
    *(b"<%b/>" % tag for tag in b"path rect circle ellipse line polygon polyline use g svg symbol a".split()),
    *b"<defs> </defs> <g> </g> <switch> </switch> <symbol> <svg> </svg> <clipPath> <style> </style>".split(),
    b"<![CDATA[", b"]]>", b"<!--", b"-->", b"<!DOCTYPE svg [", b"]>", b"&amp;", b"&#0;", b"&#x10ffff;", b"&a;",
    b'<!ENTITY a "b">', b"\0", b"\xff\xfe", b"\xef\xbb\xbf", b"\x1f\x8b", b'"', b"'", b"<", b">", b"{", b"}", b"(",
    b' fill="none"', b' stroke="red"', b' opacity="0"', b' display="none"', b' visibility="hidden"',
    b' transform="scale(0)"', b' transform="matrix(1 2 3 4 5 6)"', b' transform="rotate(30 1e8 5)"',
    b' style="fill:var(--a);--a:var(--a)"', b' style="transform:rotate(1turn)"', b' href="#a"', b' id="a"',
    b' viewBox="0 0 0 0"', b' viewBox="0 0 1e-9 1e9"', b' preserveAspectRatio="xMinYMax slice"',
    b"<style>*{fill:red}</style>", b"<style>g>:not(path):nth-child(2n+){d:path('M0 0')}</style>",
    b"<style>path:has(+ g),::x,[a*=b i]{stroke:url(#a)}@media screen{a{b:c}}</style>",
    b"M0 0", b"a1 1 0 01.5.5", b"A0 0 0 1 1 0 0", b"z", b"m", b"T", b"s1 2 3 4", b"h1e9", b"e", b",", b" ", b"\n",
]  # fmt: skip
SELECTORS = [
    "#a",
    "#1st",
    "path",
    "g > *",
    "*",
    ":not(g) path",
    "use, .st0",
    "g:has(path) path:nth-child(2n+1)",
]


def seeds(folders: list[Path]) -> list[bytes]:
    """Return the files to damage, unpacked."""
    found = []
    for folder in folders:
        for file in sorted(folder.rglob("*.svg*")):
            data = file.read_bytes()
            found.append(gzip.decompress(data) if data.startswith(b"\x1f\x8b") else data)
    if not found:
        sys.exit(f"no .svg files in {', '.join(map(str, folders))}")
    return found


def case(number: int, files: list[bytes]) -> bytes:
    """Return the file of that number."""
    rng = random.Random(number)
    if rng.random() < 0.3:
        data = document(rng)
    else:
        data = rng.choice(files)[: 2**18]
    for _ in range(rng.choice([0, 1, 1, 2, 3, 5, 8, 20])):
        data = rng.choice(DAMAGES)(rng, data, files)[: 2**20]
    if rng.random() < 0.03:
        data = gzip.compress(data, 1, mtime=0)
        data = flip(rng, data, files) if rng.random() < 0.5 else data
    return data


def flip(rng: random.Random, data: bytes, files: list[bytes]) -> bytes:
    changed = bytearray(data)
    for _ in range(rng.choice([1, 1, 4, 30])):
        if changed:
            changed[rng.randrange(len(changed))] ^= 1 << rng.randrange(8)
    return bytes(changed)


def cut(rng: random.Random, data: bytes, files: list[bytes]) -> bytes:
    start, end = span(rng, data)
    return data[:end] if rng.random() < 0.2 else data[:start] + data[end:]


def repeat(rng: random.Random, data: bytes, files: list[bytes]) -> bytes:
    start, end = span(rng, data)
    return data[:end] + data[start:end] * rng.choice([1, 2, 10, 200]) + data[end:]


def splice(rng: random.Random, data: bytes, files: list[bytes]) -> bytes:
    other = rng.choice(files)
    start, end = span(rng, other)
    place = rng.randrange(len(data) + 1)
    return data[:place] + other[start:end] + data[place:]


def insert(rng: random.Random, data: bytes, files: list[bytes]) -> bytes:
    # Mostly where something begins or ends, so that the file stays XML.
    places = [m.start() for m in re.finditer(rb"<|(?<=>)|\s", data)] if rng.random() < 0.8 else []
    place = rng.choice(places) if places else rng.randrange(len(data) + 1)
    return data[:place] + rng.choice(DICTIONARY) + data[place:]


def new_number(rng: random.Random, data: bytes, files: list[bytes]) -> bytes:
    return replaced(rng, data, NUMBER, lambda old: rng.choice(ODD_NUMBERS))


def scaled_number(rng: random.Random, data: bytes, files: list[bytes]) -> bytes:
    factor = rng.choice([-1, 0, 1e-6, 1e3, 1e7, 1e8])
    return replaced(rng, data, NUMBER, lambda old: b"%g" % (float(old) * factor))


def new_letter(rng: random.Random, data: bytes, files: list[bytes]) -> bytes:
    letters = b"MmZzLlHhVvCcSsQqTtAaXe#"
    return replaced(rng, data, rb"[MmZzLlHhVvCcSsQqTtAa]", lambda old: bytes([rng.choice(letters)]))


def swap_attributes(rng: random.Random, data: bytes, files: list[bytes]) -> bytes:
    here = [m.span() for m in re.finditer(ATTRIBUTE, data)]
    there = rng.choice([data, rng.choice(files)])
    found = re.findall(ATTRIBUTE, there)
    if not here or not found:
        return data
    start, end = rng.choice(here)
    return data[:start] + rng.choice(found) + data[end:]


def swap_values(rng: random.Random, data: bytes, files: list[bytes]) -> bytes:
    here = [m.span(1) for m in re.finditer(rb'="([^"<]*)"', data)]
    if len(here) < 2:
        return data
    (a, b), (c, d) = sorted(rng.sample(here, 2))
    return data[:a] + data[c:d] + data[b:c] + data[a:b] + data[d:]


# What leaves a file well-formed comes more often: the rest mostly ends in the XML parser.
DAMAGES = [flip, cut, repeat, splice, *3 * [insert], *6 * [new_number], *4 * [scaled_number], *4 * [new_letter],
           *6 * [swap_attributes], *6 * [swap_values]]  # fmt: skip


def span(rng: random.Random, data: bytes) -> tuple[int, int]:
    start = rng.randrange(len(data) + 1)
    return start, min(len(data), start + int(rng.choice([1, 10, 100, 3000]) * rng.random()) + 1)


def replaced(rng: random.Random, data: bytes, pattern: bytes, new) -> bytes:
    found = [m.span() for m in re.finditer(pattern, data[: 2**16])]
    for start, end in sorted(rng.sample(found, min(len(found), rng.choice([1, 1, 3, 20]))), reverse=True):
        data = data[:start] + new(data[start:end]) + data[end:]
    return data


def document(rng: random.Random) -> bytes:
    """Return a document of random elements with random attributes, most of them as they should be."""
    return f'<svg xmlns="http://www.w3.org/2000/svg"{attributes(rng, "svg")}>{content(rng, 0)}</svg>'.encode()


TAGS = "path path rect circle ellipse line polygon polyline use g g svg symbol defs a switch style".split()
VALUES = {
    "d": lambda rng: path_data(rng),
    "points": lambda rng: " ".join(number(rng) for _ in range(rng.randrange(12))),
    "transform": lambda rng: " ".join(
        f"{rng.choice('translate scale rotate skewX matrix'.split())}({numbers(rng, rng.choice([1, 2, 3, 6]))})"
        for _ in range(rng.randrange(4))
    ),
    "viewBox": lambda rng: numbers(rng, 4),
    "style": lambda rng: ";".join(f"{n}:{value(rng, n)}" for n in rng.sample(sorted(PAINTS), 3)),
    "href": lambda rng: f"#{rng.choice('abcdef')}",
    "id": lambda rng: rng.choice("abcdef"),
    "class": lambda rng: rng.choice(["x", "y", "x y"]),
}
PAINTS = {
    "fill": "none red #123 url(#a) currentColor rgb(1,2,3) hsl(9,9%,9%) var(--x) inherit oops".split(),
    "stroke": "none blue #12345678 url(#b) transparent".split(),
    "opacity": "0 1 .5 50% -1 x".split(),
    "display": "none inline block".split(),
    "visibility": "hidden visible collapse".split(),
    "fill-rule": "evenodd nonzero".split(),
    "stroke-width": "0 1 5% 1e8 -1 2em".split(),
    "font-size": "10 1e8em 0 larger".split(),
    "--x": "red var(--x) var(--y,blue)".split(),
    "transform": "scale(0) rotate(45deg) translate(10%,5px) none".split(),
    "transform-origin": "50% 50%;center;1e8 0;x".split(";"),
    "rotate": "30deg 1turn x".split(),
    "scale": "2 0 1e8".split(),
}
SIZES = "x y width height rx ry cx cy r x1 y1 x2 y2".split()
RULES = [
    "*",
    "path",
    ".x",
    "#a",
    "g > .y",
    ":not(g)",
    "use ~ *",
    "path:nth-child(2n+1)",
    "g:has(path)",
    "::x",
    "a,,b",
]


def number(rng: random.Random) -> str:
    if rng.random() < 0.03:
        return rng.choice(ODD_NUMBERS).decode()
    return f"{rng.choice([rng.randrange(-99, 99), rng.uniform(-9, 9), rng.gauss(0, 1) * 1e4]):.6g}"


def numbers(rng: random.Random, count: int) -> str:
    return rng.choice([" ", ","]).join(number(rng) for _ in range(count))


def path_data(rng: random.Random) -> str:
    arity = {"M": 2, "L": 2, "H": 1, "V": 1, "C": 6, "S": 4, "Q": 4, "T": 2, "A": 7, "Z": 0}
    text = "M" + numbers(rng, 2)
    for _ in range(rng.randrange(10)):
        letter = rng.choice(sorted(arity))
        if letter == "A":
            arc = f"{numbers(rng, 3)} {rng.choice('01')}{rng.choice('01')}{numbers(rng, 2)}"
            text += rng.choice("Aa") + " ".join([arc] * rng.choice([1, 1, 2]))
        else:
            text += rng.choice([letter, letter.lower()]) + numbers(rng, arity[letter] * rng.choice([1, 1, 2]))
    return text


def value(rng: random.Random, name: str) -> str:
    if name in VALUES and rng.random() < 0.8:
        return VALUES[name](rng)
    if name in PAINTS:
        return rng.choice(PAINTS[name])
    return number(rng) + rng.choice(["", "", "", "%", "mm", "em"])


def attributes(rng: random.Random, tag: str) -> str:
    names = set(rng.sample([*VALUES, *(n for n in PAINTS if n != "--x"), *SIZES], rng.randrange(8)))
    names |= {"path": {"d"}, "polygon": {"points"}, "polyline": {"points"}, "use": {"href"}}.get(tag, set())
    if tag in ("rect", "svg"):
        names |= {"width", "height"}
    text = "".join(f' {name}="{value(rng, name)}"' for name in sorted(names))
    return re.sub(r'(?<==")([^"]*)<', r"\1", text)


def content(rng: random.Random, depth: int) -> str:
    text = ""
    for _ in range(rng.randrange(1, 6)):
        tag = rng.choice(TAGS)
        if tag == "style":
            rules = (f"{rng.choice(RULES)}{{{VALUES['style'](rng)}}}" for _ in range(rng.randrange(4)))
            inside = "".join(rules).replace("<", "").replace("&", "")
        else:
            inside = content(rng, depth + 1) if depth < 4 and rng.random() < 0.6 else ""
        text += f"<{tag}{attributes(rng, tag)}>{inside}</{tag}>"
    return text


class TooSlow(BaseException):
    """Not an Exception, so that nothing on the way takes it for something else."""


@contextmanager
def limits(seconds: float):
    """Stop what takes longer; memory is limited once for the whole process."""

    def stop(*_: object) -> None:
        raise TooSlow(f"more than {seconds:g} s")

    signal.signal(signal.SIGALRM, stop)
    signal.setitimer(signal.ITIMER_REAL, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)


def complaint(data: bytes, number: int) -> str | None:
    """Return what is wrong with how the reader takes `data`.

    Nothing, None, when it reads it as it should; an empty text when it refuses it as it should.
    """
    select = SELECTORS[number // 7 % len(SELECTORS)] if number % 7 == 0 else None
    try:
        with limits(MOST_SECONDS):
            drawing = read("case.svg", data, lenient=number % 2 == 0, select=select)
            found = inspection(drawing)
    except InputError as error:
        is_fit = str(error).isprintable() and len(str(error)) < 1500
        return "" if is_fit else f"unfit for one line: {error!r}"
    except (Exception, TooSlow):
        return traceback.format_exc(limit=-6)
    if not drawing.shapes:
        return "a drawing without shapes"
    for shape in drawing.shapes:
        for contour in shape.contours:
            if not len(contour.segments) or not np.isfinite(contour.segments).all():
                return f"{shape.element} {shape.index}: coordinates that are not finite, or none"
    figures = [v for shape in found["shapes"] for v in (shape["length"], *shape["bbox"])]
    figures += [
        v
        for s in drawing.shapes
        for v in (s.style.stroke_width, s.style.fill_opacity, s.style.stroke_opacity)
    ]
    figures += list(drawing.viewbox or ())
    if not all(map(math.isfinite, figures)):
        return "figures that are not finite"
    if not all(note.isprintable() for note in drawing.notes):
        return "a note unfit for one line"
    return None


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("seconds", nargs="?", type=float, default=60.0)
    parser.add_argument("--seeds", nargs="+", type=Path, default=SEEDS, metavar="FOLDER")
    parser.add_argument("--start", type=int, default=0, metavar="N", help="the number of the first case")
    parser.add_argument("--case", type=Path, metavar="FILE", help="run one file that failed")
    arguments = parser.parse_args()
    resource.setrlimit(resource.RLIMIT_DATA, (MOST_BYTES, MOST_BYTES))
    if arguments.case:
        found = complaint(arguments.case.read_bytes(), int(arguments.case.stem))
        print(found or f"{arguments.case}: read or refused as it should be")
        return 1 if found else 0
    files = seeds(arguments.seeds)
    end = time.monotonic() + arguments.seconds
    number, failures, drawings, slowest = arguments.start, 0, 0, 0.0
    while time.monotonic() < end:
        data = case(number, files)
        begin = time.perf_counter()
        found = complaint(data, number)
        slowest = max(slowest, time.perf_counter() - begin)
        drawings += found is None
        if found:
            failures += 1
            FAILED.mkdir(parents=True, exist_ok=True)
            file = FAILED / f"{number}.svg"
            file.write_bytes(data)
            print(
                f"{found}\nagain: {sys.executable} tools/fuzz_reader.py --case {file.relative_to(ROOT)}",
                flush=True,
            )
        number += 1
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(
        f"{number - arguments.start} files, {drawings} of them drawings, {failures} failures; "
        f"slowest {slowest:.2f} s, {memory:.0f} MB at most; the next run: --start {number}"
    )
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
