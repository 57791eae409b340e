"""Builds from source, with and without a compiler: what is in them, and that they run."""

import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import zipfile
from functools import partial
from pathlib import Path

import pytest

import shapeblend_cli
from tests.packaging.test_build import KERNELS, MODULES, ROOT
from tools.wheels import run

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
