"""The wheel of a release: one for all versions of Python, with the results of any other build."""

import os
import re
import subprocess
import sys
import sysconfig
import tomllib
import zipfile

import pytest

from tools import wheels

KERNELS = tomllib.loads((wheels.ROOT / "pyproject.toml").read_text("utf-8"))["tool"]["shapeblend"]["kernels"]

pytestmark = pytest.mark.skipif(
    bool(sysconfig.get_config_var("Py_GIL_DISABLED")) or sys.platform == "win32",
    reason="free-threaded Python has no stable interface",
)


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    """Give the wheel, built here."""
    return wheels.build("abi3", tmp_path_factory.mktemp("wheel"))


@pytest.fixture(scope="module")
def site(wheel, tmp_path_factory):
    """Give a folder with what is in the wheel."""
    return wheels.unpacked(wheel, tmp_path_factory.mktemp("unpacked") / "site")


def test_its_name_says_that_it_is_for_every_python_from_3_11_on(wheel):
    assert re.search(r"-cp311-abi3-\w+\.whl$", wheel.name)


def test_every_kernel_is_there_compiled_and_as_source(wheel):
    names = set(zipfile.ZipFile(wheel).namelist())
    binaries = {name for name in names if name.endswith(".so")}
    assert binaries == {f"{path.removesuffix('.py')}.abi3.so" for path in KERNELS}
    assert set(KERNELS) <= names


def test_it_gives_what_the_build_in_place_gives_to_the_last_digit(site):
    assert wheels.results(site) == wheels.results(wheels.ROOT)


def test_a_light_installation_has_no_scipy_and_blends_as_any_other(wheel, tmp_path):
    """Nothing is there but what the wheel asks for: no compiler, and no other program on the path."""
    python = wheels.installed(tmp_path / "light", f"{wheel}[light]")
    assert "scipy" not in wheels.sizes(python)
    pair = [str(wheels.ROOT / "samples" / f"{name}.svg") for name in ("dancer-1", "dancer-2")]
    for command, folder in ((python.parent / "shapeblend", "light"), (sys.executable, "other")):
        module = ["-m", "shapeblend_cli"] if folder == "other" else []
        wheels.run(command, *module, *pair, "-o", tmp_path / folder / "frames", cwd=tmp_path, PATH="")
    frames = [
        {file.name: file.read_bytes() for file in (tmp_path / folder / "frames").iterdir()}
        for folder in ("light", "other")
    ]
    assert len(frames[0]) == 5
    assert frames[0] == frames[1]


@pytest.mark.parametrize("python", ["python3.12", "python3.13", "python3.14"])
def test_later_versions_of_python_load_its_kernels(site, python, tmp_path):
    """The kernels alone: they need nothing that has to be there for each version, as numpy has."""
    try:
        subprocess.run([python, "-c", ""], check=True, capture_output=True)
    except (OSError, subprocess.CalledProcessError):
        pytest.skip(f"there is no {python}")
    code = """if True:
        import importlib.machinery, importlib.util, sys
        for path in sys.argv[1:]:
            name = path.rpartition("/")[2].removesuffix(".py")
            file = path.removesuffix(".py") + ".abi3.so"
            loader = importlib.machinery.ExtensionFileLoader(name, file)
            spec = importlib.util.spec_from_file_location(name, file, loader=loader)
            importlib.util.module_from_spec(spec)
            print(name)
    """
    files = [str(site / path) for path in KERNELS]
    done = subprocess.run(
        [python, "-c", code, *files],
        cwd=tmp_path,
        env=os.environ,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.split() == [path.rpartition("/")[2].removesuffix(".py") for path in KERNELS]
