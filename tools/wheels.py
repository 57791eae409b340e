"""Build what is released into out/wheels, install it as a user does, and measure it: `make wheels`. No arguments.

It prints the tables of docs/install.md.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
from collections import defaultdict
from pathlib import Path

from tools.quality.data import ROOT
from tools.quality.tables import NONE, Table

OUT = ROOT / "out" / "wheels"

IGNORED = shutil.ignore_patterns(
    "__pycache__", "*.so", "*.pyd", ".git", ".venv", "build", "out", "*.egg-info", ".*_cache"
)
KINDS = {"abi3": {"SHAPEBLEND_ABI3": "1"}, "pure": {"SHAPEBLEND_PURE": "1"}}

PAIRS = (("bird-1", "bird-2"), ("cow", "deer"), ("dancer-1", "dancer-2"), ("e", "f"))

# Prints results to the last digit.
RESULTS = """
import sys
sys.path.insert(0, sys.argv[1])
import numpy as np
import shapeblend_cli as sb
from shapeblend_cli.matching import sweeps
assert sweeps.COMPILED and sweeps.__file__.startswith(sys.argv[1]), sweeps.__file__
rng = np.random.default_rng(5)
def ring(n, k):
    t = np.arange(n) / n * 2 * np.pi
    return (1 + 0.3 * np.sin(k * t) + 0.05 * rng.standard_normal(n)) * np.exp(1j * t)
for n, k, m in ((60, 3, 5), (200, 4, 2), (600, 2, 7)):
    found = sb.match(ring(n, k), ring(n + 11, m))
    print(repr(found.work), repr(found.lower_bound), [tuple(map(int, pair)) for pair in found.pairs])
for a, b in zip(sys.argv[2::2], sys.argv[3::2]):
    print([sb.blend(a, b).frame(t / 4).svg for t in range(5)])
"""


def run(*command: object, cwd: Path = ROOT, **environment: str) -> str:
    """Run a command, which has to succeed, and return what it prints."""
    done = subprocess.run(
        [str(each) for each in command],
        cwd=cwd,
        env={**os.environ, **environment},
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        check=False,
    )
    if done.returncode:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stdout}{done.stderr}")
    return done.stdout


def copied(folder: Path) -> Path:
    """Copy the project without anything built, so that nothing old gets into a wheel."""
    shutil.copytree(ROOT, folder, ignore=IGNORED)
    return folder


def build(kind: str, out: Path) -> Path:
    """Build a wheel of a kind into a folder."""
    pip = (sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps", "--no-build-isolation")
    with tempfile.TemporaryDirectory() as name:
        source = copied(Path(name) / "source")
        run(*pip, "--wheel-dir", out, ".", cwd=source, **{"SHAPEBLEND_PURE": "", **KINDS[kind]})
    return max(out.glob("*.whl"), key=os.path.getmtime)


def repaired(wheel: Path) -> Path:
    """Have auditwheel say which Linux systems a wheel is for; elsewhere return it as it is."""
    if not sys.platform.startswith("linux"):
        return wheel
    folder = wheel.parent / "repaired"
    shutil.rmtree(folder, ignore_errors=True)
    bin = Path(sys.executable).parent
    path = f"{bin}{os.pathsep}{os.environ['PATH']}"
    run(sys.executable, "-m", "auditwheel", "repair", "-w", folder, wheel, PATH=path)
    wheel.unlink()
    (made,) = folder.glob("*.whl")
    made = Path(shutil.move(made, wheel.parent))
    folder.rmdir()
    return made


def sdist(out: Path) -> Path:
    """Build the sdist into a folder."""
    code = "import setuptools.build_meta as b, sys; print(b.build_sdist(sys.argv[1]))"
    with tempfile.TemporaryDirectory() as name:
        source = copied(Path(name) / "source")
        return out / run(sys.executable, "-c", code, out, cwd=source).splitlines()[-1]


def installed(folder: Path, what: object) -> Path:
    """Make a virtual environment with nothing but what is asked for, from wheels alone; return its Python."""
    run(sys.executable, "-m", "venv", "--without-pip", folder)
    python = folder / "bin" / "python"
    run(sys.executable, "-m", "pip", "--python", python, "--quiet", "install", "--only-binary", ":all:", what)
    return python


def blends(python: Path) -> bool:
    """Return whether a command that was installed blends two icons, on a machine without any other program."""
    with tempfile.TemporaryDirectory() as name:
        samples = ROOT / "samples"
        command = python.parent / "shapeblend"
        run(command, samples / "e.svg", samples / "f.svg", "-q", cwd=Path(name), PATH="")
        return len(list(Path(name, "blend").glob("frame-*.svg"))) == 5


def sizes(python: Path) -> dict[str, float]:
    """Return how many MB each installed package takes, with the bytecode that pip writes."""
    (site,) = python.parents[1].glob("lib/python*/site-packages")
    found: dict[str, float] = defaultdict(float)
    for file in site.rglob("*"):
        if file.is_file():
            top = file.relative_to(site).parts[0].partition("-")[0].removesuffix(".libs").removesuffix(".py")
            found[top] += file.stat().st_size / 1e6
    return {name: round(size, 1) for name, size in sorted(found.items(), key=lambda item: -item[1])}


def results(site: Path) -> str:
    """Return what a build gives for a few problems and drawings, to the last digit."""
    files = [ROOT / "samples" / f"{name}.svg" for pair in PAIRS for name in pair]
    return run(sys.executable, "-c", RESULTS, site, *files, OPENBLAS_NUM_THREADS="1")


def unpacked(wheel: Path, folder: Path) -> Path:
    """Put a wheel into a folder, without what it requires."""
    run(sys.executable, "-m", "pip", "install", "--quiet", "--no-deps", "--target", folder, wheel)
    return folder


def main() -> None:
    shutil.rmtree(OUT, ignore_errors=True)
    OUT.mkdir(parents=True)
    wheel = repaired(build("abi3", OUT))
    pure, source = build("pure", OUT), sdist(OUT)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        full = installed(folder / "full", wheel)
        light = installed(folder / "light", f"{wheel}[light]")
        plain = installed(folder / "plain", pure)
        for python in (full, light, plain):
            if not blends(python):
                sys.exit(f"{python}: did not blend")
        found = [sizes(python) for python in (full, light)]
    print(table(*found).markdown())
    rows = [[f"`{file.name}`", f"{file.stat().st_size / 1e6:.1f} MB"] for file in (wheel, pure, source)]
    print(Table(("file", "size"), rows).markdown(), end="")


def table(full: dict[str, float], light: dict[str, float]) -> Table:
    """Return what is installed, package by package."""
    shown = [name for name, size in full.items() if size >= 1.0]
    rows = [
        [name, *(f"{each[name]:.0f} MB" if name in each else NONE for each in (full, light))]
        for name in shown
    ]
    rest = [sum(size for name, size in each.items() if name not in shown) for each in (full, light)]
    rows.append(["other packages", *(f"{size:.0f} MB" for size in rest)])
    rows.append(["**total**", *(f"**{sum(each.values()):.0f} MB**" for each in (full, light))])
    return Table(("installed", "by default", "with `[light]`"), rows)


if __name__ == "__main__":
    main()
