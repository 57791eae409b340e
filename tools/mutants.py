"""Break the package in random places, one at a time, and list the breaks that no test notices.

    python -m tools.mutants [--count 60] [--seed 1] [--jobs 2]

Each mutant is one small change of a source file: a comparison turned round, a number changed, a term or a condition
dropped, a branch never taken, an early return, a returned truth negated. It runs against the tests of the same name,
the golden tests and the tests of the same folder, in a copy of the repository. A mutant of a compiled module runs
uncompiled. A survivor is a gap in the tests, or a change that means nothing: only reading tells.
"""

from __future__ import annotations

import argparse
import ast
import random
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from queue import Queue
from typing import NamedTuple

ROOT = Path(__file__).resolve().parents[1]
PACKAGE = "shapeblend_cli"
COPIED = (
    PACKAGE,
    "tests",
    "samples",
    "tools",
    "docs",
    "conftest.py",
    "pyproject.toml",
    "README.md",
    "Makefile",
    "setup.py",
)

SECONDS = 600
"""Maximum time of the tests of one mutant, in seconds. An endless loop counts as noticed."""

OPPOSITE = {
    ast.Lt: ast.GtE,
    ast.LtE: ast.Gt,
    ast.Gt: ast.LtE,
    ast.GtE: ast.Lt,
    ast.Eq: ast.NotEq,
    ast.NotEq: ast.Eq,
    ast.In: ast.NotIn,
    ast.NotIn: ast.In,
    ast.Is: ast.IsNot,
    ast.IsNot: ast.Is,
}


class Mutant(NamedTuple):
    """A file, the lines and columns of a piece of it, and the text in its place."""

    file: str
    start: tuple[int, int]
    end: tuple[int, int]
    kind: str
    text: str

    def applied(self, source: str) -> str:
        """Return the source with the change made."""
        lines = source.encode("utf-8").splitlines(keepends=True)
        (first, begin), (last, until) = self.start, self.end
        before = b"".join(lines[: first - 1]) + lines[first - 1][:begin]
        after = lines[last - 1][until:] + b"".join(lines[last:])
        return (before + self.text.encode("utf-8") + after).decode("utf-8")


def mutants_of(file: str, source: str) -> list[Mutant]:
    """Return every mutant of a file."""
    found = []
    tree = ast.parse(source)
    annotations = {id(part) for node in ast.walk(tree) for part in _annotations(node)}

    def add(node: ast.expr | ast.stmt, kind: str, text: str) -> None:
        end = node.end_lineno or node.lineno, node.end_col_offset or 0
        found.append(Mutant(file, (node.lineno, node.col_offset), end, kind, text))

    for node in ast.walk(tree):
        if id(node) in annotations:
            continue
        match node:
            case ast.Compare(left, [operator], [right]) if type(operator) in OPPOSITE:
                turned = ast.Compare(left, [OPPOSITE[type(operator)]()], [right])
                add(node, "comparison turned", f"({ast.unparse(turned)})")
            case ast.Constant(int() | float() as number) if not isinstance(number, bool):
                add(node, "number changed", repr(number * 2 if number else 1))
            case ast.BinOp(left, ast.Add() | ast.Sub(), _):
                add(node, "term dropped", f"({ast.unparse(left)})")
            case ast.BoolOp(_, values):
                add(node, "condition dropped", f"({ast.unparse(values[0])})")
            case ast.If(test) | ast.IfExp(test):
                add(test, "branch never taken", "False")
            case ast.Return(ast.Compare() | ast.BoolOp() | ast.UnaryOp(ast.Not()) as value):
                add(value, "truth negated", f"(not ({ast.unparse(value)}))")
            case ast.FunctionDef(body=[_, *rest]) if len(rest) > 1:
                add(rest[0], "early return", "return None")
    return found


def _annotations(node: ast.AST) -> list[ast.AST]:
    roots = [getattr(node, name, None) for name in ("annotation", "returns")]
    if isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING":
        roots.append(node.test)
        roots += node.body
    return [part for root in roots if root is not None for part in ast.walk(root)]


def tests_of(file: str, tree: Path) -> list[str]:
    """Return the tests that a mutant has to face, those nearest to it first."""
    inside = Path(file).relative_to(PACKAGE)
    folder = Path("tests") / inside.parent
    same = sorted((tree / "tests").rglob(f"test_{inside.stem}.py"))
    chosen = [str(path.relative_to(tree)) for path in same] + ["tests/golden"]
    if inside.parent != Path() and (tree / folder).is_dir():
        chosen.append(str(folder))
    return chosen if len(chosen) > 1 else [*chosen, "tests/test_api.py", "tests/cli"]


def survives(mutant: Mutant, tree: Path) -> bool:
    """Return whether the tests pass in a copy of the repository with a mutant in it."""
    path = tree / mutant.file
    source = path.read_text("utf-8")
    hidden = [(binary, binary.with_suffix(".hidden")) for binary in path.parent.glob(f"{path.stem}.*.so")]
    path.write_text(mutant.applied(source), "utf-8")
    for binary, name in hidden:
        binary.rename(name)
    command = [
        sys.executable,
        "-m",
        "pytest",
        "-q",
        "-x",
        "-p",
        "no:cacheprovider",
        *tests_of(mutant.file, tree),
    ]
    try:
        done = subprocess.run(command, cwd=tree, capture_output=True, timeout=SECONDS, check=False)
    except subprocess.TimeoutExpired:
        return False
    finally:
        path.write_text(source, "utf-8")
        for binary, name in hidden:
            name.rename(binary)
    return done.returncode == 0


def main() -> None:
    parser = argparse.ArgumentParser(description="List random changes of the package that no test notices.")
    parser.add_argument("--count", type=int, default=60)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()
    files = sorted(path.relative_to(ROOT).as_posix() for path in (ROOT / PACKAGE).rglob("*.py"))
    every = [mutant for file in files for mutant in mutants_of(file, (ROOT / file).read_text("utf-8"))]
    kinds = sorted({mutant.kind for mutant in every})
    chance = random.Random(options.seed)
    # As many of each kind: most numbers mean little, and there are many.
    by_kind = {kind: chance.sample(some := [m for m in every if m.kind == kind], len(some)) for kind in kinds}
    chosen = [by_kind[kinds[k % len(kinds)]].pop() for k in range(min(options.count, len(every)))]
    with tempfile.TemporaryDirectory() as folder:
        trees: Queue[Path] = Queue()
        for k in range(options.jobs):
            tree = Path(folder, str(k))
            for name in COPIED:
                copy = shutil.copytree if (ROOT / name).is_dir() else shutil.copy
                tree.mkdir(exist_ok=True)
                copy(ROOT / name, tree / name)
            trees.put(tree)

        def outcome(mutant: Mutant) -> bool:
            tree = trees.get()
            try:
                return survives(mutant, tree)
            finally:
                trees.put(tree)

        left = 0
        with ThreadPoolExecutor(options.jobs) as pool:
            for mutant, is_left in zip(chosen, pool.map(outcome, chosen), strict=True):
                if is_left:
                    left += 1
                    print(f"{mutant.file}:{mutant.start[0]}: {mutant.kind}: {mutant.text[:90]}", flush=True)
    print(f"{len(chosen) - left} of {len(chosen)} noticed (seed {options.seed})")


if __name__ == "__main__":
    main()
