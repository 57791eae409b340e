"""Programs that some tests need and not every machine has.

Tests in `tests/browser` and `tests/docs` are skipped where one is missing. In CI `tests/docs/test_equipment.py` fails
then.
"""

import shutil
from pathlib import Path

import pytest

from tools.quality.npm import install
from tools.quality.peers import flubber, kute, polymorph

# The shell comes first: it draws the same, and has no windows of its own, which take longer to open than most pages.
BROWSERS = ("chromium-headless-shell", "chromium", "chromium-browser", "google-chrome")
CHROMIUM = next(filter(None, map(shutil.which, BROWSERS)), None)

PLAYER = Path(__file__).with_name("player")
"""The folder with the lock file of lottie-web, GSAP, React and others."""
INSTALLED = Path(__file__).parents[2] / "out" / "player"
LOTTIE_WEB = INSTALLED / "node_modules" / "lottie-web" / "build" / "player" / "lottie.min.js"


def _commands(*names):
    """A function that says which commands are missing, if any are."""
    missing = [name for name in names if not shutil.which(name)]
    return lambda: f"apt-get install {' '.join(missing)}" if missing else None


EQUIPMENT = {
    "ffmpeg": _commands("ffmpeg", "ffprobe"),
    "Inkscape": _commands("inkscape", "xvfb-run", "xauth"),
    "Chromium": lambda: None if CHROMIUM else "apt-get install chromium-headless-shell",
    "what plays and morphs in pages": lambda: install(PLAYER, INSTALLED),
    "flubber": flubber.FINE.ready,
    "KUTE.js": kute.FINE.ready,
    "polymorph": polymorph.FINE.ready,
    "fonts, icons and animations": install,
}
"""For each program a function that makes it ready, and returns None, or why it cannot."""


def require(name):
    """Skip a test that needs what is missing here."""
    if problem := EQUIPMENT[name]():
        pytest.skip(f"no {name}: {problem}")
