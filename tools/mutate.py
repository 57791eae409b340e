"""Break the package in random places, one at a time, and list the breaks that no test notices.

    python -m tools.mutate [COUNT [SEED]]

Each mutant is one small change of a source file: a comparison turned round, a number changed, a term or a condition
dropped, a branch never taken, an early return, a returned truth negated. It runs against the tests of the same name,
the golden tests and the tests of the same folder, in a copy of the repository. A mutant of a compiled module runs
uncompiled. A survivor is a gap in the tests, or a change that means nothing: only reading tells.
"""

from __future__ import annotations

import ast
import random
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path
from queue import Queue
from typing import NamedTuple

ROOT, PACKAGE = Path(__file__).resolve().parents[1], "shapeblend_cli"
LEFT_OUT = shutil.ignore_patterns(".*", "out", "build")
SECONDS = 600
"""Maximum time of the tests of one mutant, in seconds. An endless loop counts as noticed."""

PAIRS = ((ast.Lt, ast.GtE), (ast.Gt, ast.LtE), (ast.Eq, ast.NotEq), (ast.In, ast.NotIn), (ast.Is, ast.IsNot))
OPPOSITE = {one: other for pair in PAIRS for one, other in (pair, pair[::-1])}


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
            case ast.Compare(left, [operator], [right]):
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
            case ast.FunctionDef(body=[_, first, _, *_]):
                add(first, "early return", "return None")
    return found


def _annotations(node: ast.AST) -> list[ast.AST]:
    """Return what of a node only the type checker reads."""
    roots = [getattr(node, name, None) for name in ("annotation", "returns")]
    if isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING":
        roots = [node.test, *node.body]
    return [part for root in roots if root is not None for part in ast.walk(root)]


def tests_of(file: str, tree: Path) -> list[str]:
    """Return the tests that a mutant has to face, those nearest to it first."""
    inside = Path(file).relative_to(PACKAGE)
    same = sorted((tree / "tests").rglob(f"test_{inside.stem}.py"))
    chosen = [str(path.relative_to(tree)) for path in same] + ["tests/golden"]
    if inside.parent != Path() and (tree / "tests" / inside.parent).is_dir():
        chosen.append(f"tests/{inside.parent}")
    return chosen if len(chosen) > 1 else [*chosen, "tests/test_api.py", "tests/cli"]


def survives(mutant: Mutant, trees: Queue[Path]) -> bool:
    """Return whether the tests pass in a copy of the repository, one that is free, with a mutant in it."""
    tree = trees.get()
    path = tree / mutant.file
    source = path.read_text("utf-8")
    hidden = {binary: binary.with_suffix(".hidden") for binary in path.parent.glob(f"{path.stem}.*.so")}
    path.write_text(mutant.applied(source), "utf-8")
    for binary, name in hidden.items():
        binary.rename(name)
    command = [sys.executable, *"-m pytest -q -x -p no:cacheprovider".split(), *tests_of(mutant.file, tree)]
    try:
        done = subprocess.run(command, cwd=tree, capture_output=True, timeout=SECONDS, check=False)
    except subprocess.TimeoutExpired:
        return False
    finally:
        path.write_text(source, "utf-8")
        for binary, name in hidden.items():
            name.rename(binary)
        trees.put(tree)
    return done.returncode == 0


def chosen(count: int, seed: int) -> list[Mutant]:
    """Return random mutants, as many of each kind: most numbers mean little, and there are many."""
    files = sorted(path.relative_to(ROOT).as_posix() for path in (ROOT / PACKAGE).rglob("*.py"))
    by_kind: dict[str, list[Mutant]] = {}
    for mutant in (each for file in files for each in mutants_of(file, (ROOT / file).read_text("utf-8"))):
        by_kind.setdefault(mutant.kind, []).append(mutant)
    chance, kinds = random.Random(seed), sorted(by_kind)
    return [chance.choice(by_kind[kinds[k % len(kinds)]]) for k in range(count)]


def main(count: int = 60, seed: int = 1) -> None:
    """Test mutants, two at a time, and print the survivors."""
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(2) as pool:
        trees: Queue[Path] = Queue()
        for name in "01":
            trees.put(Path(shutil.copytree(ROOT, Path(folder, name), ignore=LEFT_OUT)))

        mutants, left = chosen(count, seed), 0
        for mutant, is_left in zip(mutants, pool.map(partial(survives, trees=trees), mutants), strict=True):
            if is_left:
                left += 1
                print(f"{mutant.file}:{mutant.start[0]}: {mutant.kind}: {mutant.text[:90]}", flush=True)
    print(f"{count - left} of {count} noticed (seed {seed})")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
