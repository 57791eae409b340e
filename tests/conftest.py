"""Shared settings and fixtures."""

import gc
import importlib.util
import os
import pickle
import sys
from pathlib import Path

# As of a command, before numpy is imported: more threads gain nothing, and spin while they wait.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import hypothesis
import numpy as np
import pytest

from tests.support.forked import SUBPROCESS

ROOT = Path(__file__).parents[1]
SAMPLES = ROOT / "samples"

hypothesis.settings.register_profile("repeatable", derandomize=True, deadline=None, max_examples=30)
hypothesis.settings.register_profile("thorough", deadline=None, max_examples=300)
hypothesis.settings.load_profile("repeatable")


@pytest.hookimpl(wrapper=True)
def pytest_collection():
    """Collect tests without a search for garbage, leave what they are out of later searches, and search seldom."""
    gc.disable()
    try:
        return (yield)
    finally:
        gc.freeze()
        gc.set_threshold(20_000)
        gc.enable()


@pytest.fixture
def rng():
    """Random numbers that are the same in every run."""
    return np.random.default_rng(1992)


@pytest.fixture
def samples():
    """The folder of sample drawings."""
    return SAMPLES


@pytest.fixture
def here(tmp_path, monkeypatch):
    """An empty folder, which is the current one."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def forked(monkeypatch):
    """Fork the processes of batches and of studios."""
    monkeypatch.setattr("shapeblend_cli.system.processes.subprocess", SUBPROCESS)


@pytest.fixture(scope="module")
def blended_once(request):
    """Blend the same drawings with the same settings once, for tests that look at a blend in several ways.

    It is not for tests that change how drawings are blended, or time that, or compare a blend with the same one again.
    """
    from shapeblend_cli.pipeline import match_all

    made = {}

    def match(drawings, settings, *others):
        key = pickle.dumps((drawings, settings))
        if key not in made:
            made[key] = match_all(drawings, settings, *others)
        return tuple(map(list, made[key]))

    with pytest.MonkeyPatch.context() as once:
        once.setattr(
            request.module, "match_all", match, raising=False
        )  # some use it only through the package
        for module in ("shapeblend_cli.job.make", "shapeblend_cli.api"):
            once.setattr(f"{module}.match_all", match)
        yield


@pytest.fixture
def load_uncompiled(monkeypatch):
    """Load a kernel from its source, under another name, as on a machine without Cython."""

    def load(name):
        source = ROOT / (name.replace(".", "/") + ".py")
        spec = importlib.util.spec_from_file_location(f"{name}_uncompiled", source)
        module = importlib.util.module_from_spec(spec)
        with monkeypatch.context() as without_cython:
            without_cython.setitem(sys.modules, "cython", None)
            spec.loader.exec_module(module)
        return module

    return load
