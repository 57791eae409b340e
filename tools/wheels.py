"""Build what is released, install it as a user does, and measure it: `make wheels`. No arguments.

Writes the wheels and the sdist into out/wheels, docs/install.json, and the figures of docs/install.md and of the README
from that. With `--again` it does only the last.
"""

from __future__ import annotations

import json
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
from collections import defaultdict
from importlib.metadata import version
from pathlib import Path
from typing import Any

from tools.quality.data import ROOT
from tools.quality.tables import Table, with_figures

OUT = ROOT / "out" / "wheels"
DOCUMENT, SCORES = ROOT / "docs" / "install.md", ROOT / "docs" / "install.json"
README = ROOT / "README.md"
SIZE, END_OF_SIZE = "<!-- size: written by make wheels -->", "<!-- end of size -->"
BEGIN, END = "<!-- figures: written by make wheels -->", "<!-- end of figures -->"

IGNORED = shutil.ignore_patterns(
    "__pycache__", "*.so", "*.pyd", ".git", ".venv", "build", "out", "*.egg-info", ".*_cache"
)
KINDS = {"abi3": {"SHAPEBLEND_ABI3": "1"}, "bound": {}, "pure": {"SHAPEBLEND_PURE": "1"}}

RUNS = 60
"""How often each of two builds is timed, in turn: what else a machine does meanwhile slows both down alike."""

PAIRS = (("bird-1", "bird-2"), ("cow", "deer"), ("dancer-1", "dancer-2"), ("e", "f"))

# Prints results to the last digit in two lines, then for each line that it reads the seconds of the processor that one
# kind of work took.
TIMED = """
import sys, time
sys.path.insert(0, sys.argv[1])
import numpy as np
import shapeblend_cli as sb
from shapeblend_cli.matching import sweeps
assert sweeps.COMPILED and sweeps.__file__.startswith(sys.argv[1]), sweeps.__file__
rng = np.random.default_rng(5)
def ring(n, k):
    t = np.arange(n) / n * 2 * np.pi
    return (1 + 0.3 * np.sin(k * t) + 0.05 * rng.standard_normal(n)) * np.exp(1j * t)
rings = [(ring(n, k), ring(n + 11, m)) for n, k, m in ((60, 3, 5), (200, 4, 2), (600, 2, 7))]
drawings = list(zip(sys.argv[2::2], sys.argv[3::2]))
def match():
    return [sb.match(a, b) for a, b in rings]
def draw():
    return [[sb.blend(a, b).frame(t / 4).svg for t in range(5)] for a, b in drawings]
for found in match():
    print(repr(found.work), repr(found.lower_bound), [tuple(map(int, pair)) for pair in found.pairs], end=" ")
print()
print(draw())
sys.stdout.flush()
for line in sys.stdin:
    began = time.process_time()
    (match if line.strip() == "match" else draw)()
    print(time.process_time() - began, flush=True)
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


def compared(one: Path, other: Path, runs: int = RUNS) -> dict[str, Any]:
    """Compare what two builds give to the last digit, and time them in turn."""
    files = [str(ROOT / "samples" / f"{name}.svg") for pair in PAIRS for name in pair]
    builds = [
        subprocess.Popen(
            [sys.executable, "-c", TIMED, str(site), *files],
            env={**os.environ, "OPENBLAS_NUM_THREADS": "1"},
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        for site in (one, other)
    ]
    try:
        printed = [[_line(build), _line(build)] for build in builds]
        seconds = {
            work: [[_seconds(build, work) for build in builds] for _ in range(runs)]
            for work in ("match", "draw")
        }
    finally:
        for build in builds:
            build.communicate()
    return {
        "equal": printed[0] == printed[1],
        "runs": runs,
        "least": [round(min(a for a, _ in each) / min(b for _, b in each), 4) for each in seconds.values()],
        "median": [round(statistics.median(a / b for a, b in each), 4) for each in seconds.values()],
    }


def _line(build: subprocess.Popen[str]) -> str:
    assert build.stdout is not None
    line = build.stdout.readline()
    if not line:
        sys.exit(f"{build.args[3]}: ended with status {build.wait()}")  # type: ignore[index]
    return line


def _seconds(build: subprocess.Popen[str], work: str) -> float:
    assert build.stdin is not None
    print(work, file=build.stdin, flush=True)
    return float(_line(build))


def unpacked(wheel: Path, folder: Path) -> Path:
    """Put a wheel into a folder, without what it requires."""
    run(sys.executable, "-m", "pip", "install", "--quiet", "--no-deps", "--target", folder, wheel)
    return folder


def measured() -> dict[str, Any]:
    """Build everything, check and measure it."""
    shutil.rmtree(OUT, ignore_errors=True)
    OUT.mkdir(parents=True)
    wheel = repaired(build("abi3", OUT))
    pure, source = build("pure", OUT), sdist(OUT)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        bound = build("bound", folder / "bound")
        full = installed(folder / "full", wheel)
        light = installed(folder / "light", f"{wheel}[light]")
        plain = installed(folder / "plain", pure)
        for python in (full, light, plain):
            if not blends(python):
                sys.exit(f"{python}: did not blend")
        sites = [unpacked(each, folder / f"site-{k}") for k, each in enumerate((wheel, bound))]
        return {
            "python": ".".join(map(str, sys.version_info[:2])),
            "cython": version("Cython"),
            "files": {each.name: round(each.stat().st_size / 1e6, 2) for each in (wheel, pure, source)},
            "full": sizes(full),
            "light": sizes(light),
            "speed": compared(*sites),
        }


def figures(found: dict[str, Any]) -> str:
    """Return the tables, with the lines around them."""
    full, light, speed = found["full"], found["light"], found["speed"]
    shown = [name for name, size in full.items() if size >= 1.0]
    rows = [
        [name, f"{full[name]:.0f} MB", f"{light[name]:.0f} MB" if name in light else "–"] for name in shown
    ]
    rest = [sum(size for name, size in each.items() if name not in shown) for each in (full, light)]
    rows.append(["other packages", *(f"{size:.0f} MB" for size in rest)])
    rows.append(["**total**", *(f"**{sum(each.values()):.0f} MB**" for each in (full, light))])
    table = Table(("installed", "by default", "with `[light]`"), rows).markdown()
    files = Table(("file", "size"), [[f"`{n}`", f"{size:.2f} MB"] for n, size in found["files"].items()])
    solver, whole = (
        [f"{100 * (one[k] - 1):+.1f} %" for one in (speed["least"], speed["median"])] for k in (0, 1)
    )
    rows = [["solver alone", *solver], ["whole blends, from reading to drawing", *whole]]
    time = Table(
        ("time of the abi3 wheel, compared with a build for one Python", "least", "median"), rows
    ).markdown()
    same = "the same to the last digit" if speed["equal"] else "not the same"
    words = (
        f"The two builds were timed with Python {found['python']} and Cython {found['cython']}, in {speed['runs']} "
        f"runs of each, in turn, by processor time. Their results are {same}."
    )
    return f"{BEGIN}\n\n{table}\n{files.markdown()}\n{words}\n\n{time}\n{END}"


def size(found: dict[str, Any]) -> str:
    """Return what the README says of sizes, with the lines around it."""
    full, light = (sum(found[name].values()) for name in ("full", "light"))
    return (
        f"{SIZE}\nInstalled, it takes up {full:.0f} MB, or {light:.0f} MB as `shapeblend[light]`, which leaves out "
        f"scipy.\n{END_OF_SIZE}"
    )


def main() -> None:
    if "--again" not in sys.argv[1:]:
        SCORES.write_text(f"{json.dumps(measured(), indent=1)}\n", encoding="utf-8")
    found = json.loads(SCORES.read_text(encoding="utf-8"))
    README.write_text(
        with_figures(README.read_text(encoding="utf-8"), size(found), SIZE, END_OF_SIZE), encoding="utf-8"
    )
    DOCUMENT.write_text(
        with_figures(DOCUMENT.read_text(encoding="utf-8"), figures(found), BEGIN, END), encoding="utf-8"
    )


if __name__ == "__main__":
    main()
