"""Measure batches beside the same jobs as separate commands: python -m tools.batches [KIND ...] [--rounds N].

Separate commands start one after another. All ways take turns, and the least time of a way in all rounds counts, and so
does its processor time, which depends less on what else the machine does. What a batch writes is compared with what the
commands write, byte for byte.
"""

from __future__ import annotations

import argparse
import json
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from itertools import combinations
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from tools.quality.data import ROOT, icon_pairs, svg

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

ROUNDS = 3

PLAIN = 80
"""Number of plain pairs."""

SET = 25
"""Number of icons of which every two are blended."""

ICONS = ROOT / "docs" / "icons"

COMMAND = [sys.executable, "-m", "shapeblend_cli"]

Row = dict[str, str]


class Kind(NamedTuple):
    """Jobs that are alike."""

    what: str
    rows: Callable[[Path], Iterable[Row]]  # written into a folder
    suffix: str = ".svg"  # of the outputs; empty for a folder of frames
    options: tuple[str, ...] = ()


def plain(folder: Path) -> Iterable[Row]:
    """Write plain pairs of one contour each."""
    for k, pair in enumerate(icon_pairs("single")[:PLAIN]):
        for name, data in (("a", pair.a), ("b", pair.b)):
            (folder / f"{k}{name}.svg").write_text(svg(data), "utf-8")
        yield {"a": f"{k}a.svg", "b": f"{k}b.svg"}


def unlike(folder: Path) -> Iterable[Row]:
    """Copy the pairs of docs/icons, but for those with a drawing that another pair has."""
    seen: set[str] = set()
    for pair in json.loads((ICONS / "pairs.json").read_text("utf-8")):
        files = [pair[side] for side in "ab"]
        if seen.isdisjoint(files):
            seen.update(files)
            yield {side: _copied(ICONS / file, folder) for side, file in zip("ab", files, strict=True)}


def every_two(folder: Path) -> Iterable[Row]:
    """Copy icons of one set, and pair every two."""
    files = sorted((ICONS / "lucide").glob("*.svg"))
    names = [_copied(file, folder) for file in files[:: len(files) // SET][:SET]]
    for a, b in combinations(names, 2):
        yield {"a": a, "b": b}


KINDS = {
    "frames": Kind(f"{PLAIN} plain pairs, nine frames each", plain, "", ("-n", "9")),
    "plain": Kind(f"{PLAIN} plain pairs, an animated SVG each", plain),
    "icons": Kind("pairs of docs/icons, no icon twice, an animated SVG each", unlike),
    "set": Kind(f"every two of {SET} icons of Lucide, an animated SVG each", every_two),
}


def _copied(file: Path, folder: Path) -> str:
    name = f"{file.parent.name}-{file.name}"
    shutil.copy(file, folder / name)
    return name


class Taken(NamedTuple):
    """What a way takes, in seconds."""

    time: float
    work: float  # of processors


def taken(act: Callable[[], None]) -> Taken:
    """Return what running commands takes."""
    began, before = time.perf_counter(), resource.getrusage(resource.RUSAGE_CHILDREN)
    act()
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    work = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return Taken(time.perf_counter() - began, work)


def contents(folder: Path) -> dict[str, bytes]:
    """Return the outputs in a folder, without the records of a batch."""
    files = (path for path in sorted(folder.rglob("*")) if path.is_file())
    inside = {path.relative_to(folder): path for path in files}
    return {str(name): path.read_bytes() for name, path in inside.items() if ".shapeblend" not in name.parts}


def measured(kind: Kind, rounds: int) -> tuple[int, dict[str, Taken]]:
    """Return the number of jobs and the least that each way takes."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        outs = {way: folder / way for way in ("commands", "-j 1", "-j 2")}
        rows = [{**row, "o": f"{k}{kind.suffix}"} for k, row in enumerate(kind.rows(folder))]

        def run(way: str) -> None:
            """Do all jobs in one way."""
            if way == "commands":
                for row in rows:
                    files = [row["a"], row["b"], "-o", str(outs[way] / row["o"])]
                    subprocess.run([*COMMAND, *files, "-q", *kind.options], check=True, cwd=folder)
            else:
                lines = (json.dumps(row | {"o": f"{way}/{row['o']}"}) for row in rows)
                (folder / "jobs.jsonl").write_text("\n".join(lines), "utf-8")
                line = [*COMMAND, "batch", "jobs.jsonl", *way.split(), "-q", *kind.options]
                subprocess.run(line, check=True, cwd=folder)

        turns = []
        for _ in range(rounds):
            for out in outs.values():
                shutil.rmtree(out, ignore_errors=True)
                out.mkdir()
            turns.append({way: taken(lambda way=way: run(way)) for way in outs})  # type: ignore[misc]
            made = {way: contents(out) for way, out in outs.items()}
            for way in ("-j 1", "-j 2"):
                if made[way] != made["commands"]:
                    sys.exit(f"batch {way} does not write what separate commands write")
        best = {way: Taken(*map(min, zip(*(turn[way] for turn in turns), strict=True))) for way in outs}
        return len(rows), best


def main(arguments: Sequence[str] | None = None) -> None:
    """Measure kinds of jobs, and print what each way takes, and how many times as fast batches are."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("kinds", nargs="*", metavar="KIND", help=", ".join(KINDS))
    parser.add_argument("--rounds", type=int, default=ROUNDS)
    given = parser.parse_args(arguments)
    for name in given.kinds or KINDS:
        count, best = measured(KINDS[name], given.rounds)
        print(f"{KINDS[name].what}: {count} jobs")
        for way, each in best.items():
            fast, cheap = best["commands"].time / each.time, best["commands"].work / each.work
            print(
                f"  {way:9}{1000 * each.time / count:8.1f} ms a job, {fast:5.2f} times as fast as commands; "
                f"of processors {1000 * each.work / count:6.1f} ms, {cheap:5.2f} times as cheap"
            )
        sys.stdout.flush()


if __name__ == "__main__":
    main()
