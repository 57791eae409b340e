"""Kernels run uncompiled, and the command starts without heavy imports."""

import doctest
import importlib
import os
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

from shapeblend_cli import _cython

ROOT = Path(__file__).parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
KERNELS = PROJECT["tool"]["shapeblend"]["kernels"]
MODULES = [path.removesuffix(".py").replace("/", ".") for path in KERNELS]


def imported_by(arguments, folder, status=0):
    done = subprocess.run(
        [sys.executable, "-X", "importtime", "-m", "shapeblend_cli", *arguments],
        cwd=folder,
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == status, done.stderr
    return {line.rpartition("|")[2].strip() for line in done.stderr.splitlines()}


@pytest.mark.parametrize(
    ("arguments", "status"),
    [
        (["--help"], 0),
        (["--version"], 0),
        (["plot", "--help"], 0),
        (["completion", "bash"], 0),
        (["a.svg", "b.svg", "--nope"], 2),
        (["no-such-file.svg", "b.svg"], 1),
    ],
    ids=str,
)
def test_command_starts_without_heavy_imports(arguments, status, tmp_path):
    imported = imported_by(arguments, tmp_path, status)
    assert "click" in imported
    heavy = {"numpy", "scipy", "svgpathtools", "svgwrite", "tinycss2", "cssselect2"}
    assert imported & heavy == set()


def test_a_blend_imports_nothing_heavy_that_it_does_not_need(samples, tmp_path):
    imported = imported_by([samples / "bird-1.svg", samples / "bird-2.svg"], tmp_path)
    assert "numpy" in imported
    # numpy.ma comes with the first call of numpy.unique and its kin.
    assert imported & {"scipy", "numpy.ma", "rich", "lap", "json", "difflib", "PIL", "resvg_py"} == set()
    others = "preview", "grading", "studio", "batch", "plot", "outputs.video", "outputs.lottie", "outputs.avd"
    beginnings = tuple(f"shapeblend_cli.{other}" for other in others)
    assert [name for name in imported if name.startswith(beginnings)] == []


def test_filled_icons_are_blended_without_what_lines_mixtures_and_other_outputs_need(samples, tmp_path):
    imported = imported_by([samples / "e.svg", samples / "f.svg", "-o", "x.svg"], tmp_path)
    assert imported & {"svgwrite", "coloraide", "numpy.ma", "decimal", "tempfile", "subprocess"} == set()
    lines = "pens.line_blends pens.moves motion.pen blending.strokes.several blending.strokes.drawn"
    others = f"{lines} interpolate.stars job.report svg.writing.css".split()
    assert imported & {f"shapeblend_cli.{other}" for other in others} == set()


@pytest.mark.parametrize("name", MODULES)
def test_doctests_of_a_kernel_hold_uncompiled(name, load_uncompiled):
    module = load_uncompiled(name)
    assert not module.COMPILED
    assert importlib.import_module(name) is not module
    assert doctest.testmod(module).failed == 0


def test_stand_in_for_cython_has_what_kernels_use_and_no_more():
    used = set()
    for path in KERNELS:
        used |= set(re.findall(r"\bcython\.(\w+)", (ROOT / path).read_text(encoding="utf-8")))
    imported = {"Any", "Final", "namedtuple", "look_for_signals", "trunc"}
    compiled_alone = {"cimports", "address", "char", "NULL"}
    assert used - compiled_alone == {name for name in vars(_cython) if name[0] != "_"} - imported


@pytest.mark.parametrize("name", MODULES)
def test_a_kernel_is_compiled_in_ci_and_its_binary_is_not_older_than_its_source(name):
    module = importlib.import_module(name)
    if not module.COMPILED:
        assert os.environ.get("CI") != "true" or os.environ.get("SHAPEBLEND_PURE")
        pytest.skip(f"{name} is not compiled here")
    binary = Path(module.__file__)
    source = binary.with_name(name.rpartition(".")[2] + ".py")
    assert binary.stat().st_mtime >= source.stat().st_mtime, "the source was edited: run make install"


def test_kernels_are_the_modules_that_import_cython_and_mypy_is_told():
    package = ROOT / "shapeblend_cli"
    uses = re.compile(r"^\s*import cython$", re.MULTILINE)
    found = [path for path in package.rglob("*.py") if uses.search(path.read_text(encoding="utf-8"))]
    assert sorted(path.relative_to(ROOT).as_posix() for path in found) == sorted(KERNELS)
    overrides = PROJECT["tool"]["mypy"]["overrides"]
    told = [one["module"] for one in overrides if "valid-type" in one.get("disable_error_code", [])]
    assert told == [sorted(MODULES)]
