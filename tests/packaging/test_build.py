"""What a build contains, that it needs no compiler, and that the command starts without heavy imports."""

import doctest
import importlib
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import tomllib
import zipfile
from functools import partial
from pathlib import Path

import pytest

import shapeblend_cli
from shapeblend_cli import _cython
from tools.wheels import run

ROOT = Path(__file__).parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
KERNELS = PROJECT["tool"]["shapeblend"]["kernels"]
MODULES = [path.removesuffix(".py").replace("/", ".") for path in KERNELS]
PARTS = ["LICENSE", "MANIFEST.in", "Makefile", "README.md", "pyproject.toml", "setup.py"]
PARTS += ["conftest.py", "samples", "share", "shapeblend_cli", "tests", "tools"]
BUILT = shutil.ignore_patterns("__pycache__", "*.so", "*.pyd")
DATA = re.compile(r"\.(dist-info|data)/")
BINARY = re.compile(r"\.(so|pyd|c)$")


python = partial(run, sys.executable)


@pytest.fixture(scope="module")
def source(tmp_path_factory):
    """Give a copy of the project without anything that was built in place."""
    copy = tmp_path_factory.mktemp("source") / "shapeblend"
    copy.mkdir()
    for name in PARTS:
        if (ROOT / name).is_dir():
            shutil.copytree(ROOT / name, copy / name, ignore=BUILT)
        else:
            shutil.copy(ROOT / name, copy / name)
    return copy


@pytest.fixture(scope="module")
def wheel(source):
    """Build a wheel where every compile fails."""
    no_compiler = shutil.which("false")
    if no_compiler is None:
        pytest.skip("needs a command that fails, to stand for the compiler")
    python(
        *("-m", "pip", "wheel", "--quiet", "--no-index", "--no-deps", "--no-build-isolation"),
        *("--wheel-dir", "dist", "."),
        cwd=source,
        CC=no_compiler,
        SHAPEBLEND_PURE="",
    )
    (path,) = (source / "dist").glob("*.whl")
    return path


def test_without_a_compiler_it_installs_and_its_kernels_run_as_python(wheel, tmp_path):
    python(
        *("-m", "pip", "install", "--quiet", "--no-index", "--no-deps", "--target", "site", wheel),
        cwd=tmp_path,
    )
    site = tmp_path / "site"
    assert [path for path in site.rglob("*") if BINARY.search(path.name)] == []
    code = """if True:
        import importlib, sys
        sys.modules["cython"] = None  # as on a machine without Cython
        for name in sys.argv[1:]:
            module = importlib.import_module(name)
            print(module.__file__, bool(module.COMPILED))
    """
    printed = python("-c", code, *MODULES, cwd=tmp_path, PYTHONPATH=str(site)).splitlines()
    assert printed == [f"{site / path} False" for path in KERNELS]


def test_wheel_carries_the_package_only_with_the_source_of_its_kernels(wheel):
    assert wheel.name.startswith(f"shapeblend-{shapeblend_cli.__version__}-")
    names = zipfile.ZipFile(wheel).namelist()
    assert {name.split("/")[0] for name in names if not DATA.search(name)} == {"shapeblend_cli"}
    assert [name for name in names if name.endswith(".data/data/share/man/man1/shapeblend.1")]
    modules = {path.relative_to(ROOT).as_posix() for path in (ROOT / "shapeblend_cli").rglob("*.py")}
    assert modules == {name for name in names if name.endswith(".py")}
    assert set(KERNELS) <= modules
    page = {p for p in (ROOT / "shapeblend_cli/preview").iterdir() if p.suffix in (".html", ".css", ".js")}
    assert {path.relative_to(ROOT).as_posix() for path in page} <= set(names)
    assert {path.suffix for path in page} == {".html", ".css", ".js"}


def test_pure_build_fits_every_platform(source, tmp_path):
    build = "import setuptools.build_meta as b, sys; print(b.build_wheel(sys.argv[1]))"
    printed = python("-c", build, tmp_path, cwd=source, SHAPEBLEND_PURE="1")
    assert printed.splitlines()[-1].endswith("-py3-none-any.whl")


def test_sdist_carries_tests_and_samples_and_nothing_built(source, tmp_path):
    build = "import setuptools.build_meta as b, sys; print(b.build_sdist(sys.argv[1]))"
    printed = python("-c", build, tmp_path, cwd=source, SHAPEBLEND_PURE="")
    with tarfile.open(tmp_path / printed.splitlines()[-1]) as archive:
        names = {name.partition("/")[2] for name in archive.getnames()}
    here = Path(__file__).relative_to(ROOT).as_posix()
    assert {here, "samples/e.svg", "samples/f.svg", "setup.py", "Makefile", "LICENSE", *KERNELS} <= names
    assert [name for name in names if BINARY.search(name) or name.startswith("build/")] == []


def test_a_wheel_for_everybody_is_not_built_without_its_binaries(source, tmp_path):
    no_compiler = shutil.which("false")
    if no_compiler is None:
        pytest.skip("needs a command that fails, to stand for the compiler")
    if sysconfig.get_config_var("Py_GIL_DISABLED"):
        pytest.skip("free-threaded Python has no stable interface")
    build = "import setuptools.build_meta as b, sys; print(b.build_wheel(sys.argv[1]))"
    done = subprocess.run(
        [sys.executable, "-c", build, tmp_path],
        cwd=source,
        env={**os.environ, "CC": no_compiler, "SHAPEBLEND_ABI3": "1", "SHAPEBLEND_PURE": ""},
        capture_output=True,
        check=False,
    )
    assert done.returncode != 0
    assert [*tmp_path.iterdir()] == []


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
    lines = "pens.line_blends pens.moves motion.pen blending.several blending.drawn"
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
    imported = {"Any", "Final", "namedtuple", "look_for_signals"}
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
