"""What npm installs from a lock file of ours, into `out/`: libraries, fonts, icons and animations."""

from __future__ import annotations

import fcntl
import functools
import json
import shutil
import subprocess
from pathlib import Path
from typing import Any

from tools.quality.data import ROOT

PACKAGES = Path(__file__).with_name("packages")
INSTALLED = ROOT / "out" / "npm"
MODULES = INSTALLED / "node_modules"


@functools.cache
def install(source: Path = PACKAGES, target: Path = INSTALLED) -> str | None:
    """Install what a folder's package.json asks for, or return why that cannot be."""
    if not (shutil.which("node") and shutil.which("npm")):
        return "node and npm are not there"
    target.mkdir(parents=True, exist_ok=True)
    with open(target / ".lock", "w") as file:
        fcntl.flock(file, fcntl.LOCK_EX)  # of several processes one installs, and the others wait
        return _install(source, target)


def _install(source: Path, target: Path) -> str | None:
    known = target / "node_modules" / ".package-lock.json"
    lock = target / "package-lock.json"
    if known.exists() and lock.read_bytes() == (source / lock.name).read_bytes():
        return None
    for name in ("package.json", lock.name):
        shutil.copyfile(source / name, target / name)
    quietly = "--loglevel=error --no-audit --no-fund --ignore-scripts --fetch-retries=1".split()
    done = subprocess.run(["npm", "ci", *quietly], cwd=target, stdout=subprocess.DEVNULL, check=False)
    return "npm could not install it" if done.returncode else None


@functools.cache
def icon_set(name: str) -> dict[str, Any]:
    """Return what a set of icons has."""
    return json.loads((MODULES / "@iconify-json" / name / "icons.json").read_text(encoding="utf-8"))


def icon_file(icons: str, name: str) -> str:
    """Return the document that draws an icon of a set."""
    known = icon_set(icons)
    icon = known["icons"][name]
    width, height = (icon.get(side, known.get(side, 16)) for side in ("width", "height"))
    box = f"{icon.get('left', 0)} {icon.get('top', 0)} {width} {height}"
    return f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{box}">{icon["body"]}</svg>'
