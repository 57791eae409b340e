"""The files of the extension, and where they go."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING
from xml.sax.saxutils import escape, quoteattr

from shapeblend_cli.inkscape.options import InkscapeOptions
from shapeblend_cli.options.easing import NAMES as EASES
from shapeblend_cli.options.settings import Settings
from shapeblend_cli.system.write import check_targets, write_files

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.options.fields import Option

SCRIPT = "shapeblend.py"

PATIENCE = 60.0  # seconds for Inkscape to say where its folder is

INX = """\
<?xml version="1.0" encoding="UTF-8"?>
<inkscape-extension xmlns="http://www.inkscape.org/namespace/inkscape/extension">
  <name>{name}</name>
  <id>org.shapeblend.{what}</id>
  <param name="what" type="string" gui-hidden="true">{what}</param>
{params}
  <label appearance="header">Pins and pairs</label>
  <label>{pins}</label>
  <effect{live}>
    <object-type>all</object-type>
    <effects-menu><submenu name="Shapeblend"/></effects-menu>
  </effect>
  <script><command location="inx" interpreter="python">{script}</command></script>
</inkscape-extension>
"""

PINS = (
    "Two dots labelled 'pin 1', or a line with that label from one object to the other, mark points that become "
    "each other. Further pins are 'pin 2' and so on. Parts of two groups that are both labelled 'pair 1' become each "
    "other."
)

FILE_TYPES = "svg,gif,webp,apng,json,xml"


def files() -> dict[str, str]:
    """Return the texts of the extension's files by their names."""
    choices = [
        _choice(Settings.options["motion"], "Motion:"),
        _choice(Settings.options["ease"], "Easing:", tuple(EASES)),
    ]
    frames = _number(Settings.options["frames"], "In-betweens:", 1, 100)
    placed = _choice(InkscapeOptions.options["frames_as"], "In-betweens are:")
    path = (
        f'  <param name="output" type="path" mode="file_new" filetypes="{FILE_TYPES}" '
        'gui-text="Animation to write:"></param>'
    )
    seconds = '  <param name="duration" type="float" min="0.01" max="3600" gui-text="Seconds:">2</param>'
    repeat = _options("repeat", "Runs:", ("forever", "pingpong", "1"), "forever")
    trigger = _options("trigger", "Begins with:", ("load", "click", "hover"), "load")
    force = '  <param name="force" type="bool" gui-text="Replace an existing file">false</param>'
    return {
        "shapeblend_blend.inx": _inx("blend", "Blend", [frames, placed, *choices], is_live=True),
        "shapeblend_animate.inx": _inx(
            "animate", "Write an animation", [path, force, seconds, repeat, trigger, *choices], is_live=False
        ),
        "shapeblend_studio.inx": _inx("studio", "Open in the studio", [], is_live=False),
        SCRIPT: _script(),
    }


def _inx(what: str, name: str, params: Sequence[str], *, is_live: bool) -> str:
    live = "" if is_live else ' needs-live-preview="false"'
    return INX.format(
        what=what, name=name, params="\n".join(params), live=live, script=SCRIPT, pins=escape(PINS)
    )


def _number(option: Option, text: str, low: int, high: int) -> str:
    name = option.flags[-1].lstrip("-")
    return f'  <param name="{name}" type="int" min="{low}" max="{high}" gui-text="{text}">{option.default}</param>'


def _choice(option: Option, text: str, choices: tuple[str, ...] = ()) -> str:
    name, default = option.flags[-1].lstrip("-"), str(option.default)
    return _options(name, text, choices or option.kind.choices, default, option.help)


def _options(name: str, text: str, choices: Sequence[str], default: str, help: str = "") -> str:
    ordered = [default, *(choice for choice in choices if choice != default)]  # the first one is the default
    lines = [f"    <option value={quoteattr(choice)}>{escape(choice)}</option>" for choice in ordered]
    told = f" gui-description={quoteattr(help)}" if help else ""
    head = f'  <param name="{name}" type="optiongroup" appearance="combo" gui-text="{text}"{told}>'
    return "\n".join([head, *lines, "  </param>"])


def _script() -> str:
    """Return the script with the command that installs it."""
    text = Path(__file__).with_name("script.py").read_text(encoding="utf-8")
    command = [sys.executable, "-m", "shapeblend_cli"]
    return text.replace("] | None = None", f"] | None = {json.dumps(command)}", 1)


def folder_of_extensions() -> Path:
    """Return the folder in which Inkscape looks for the user's extensions."""
    if profile := os.environ.get("INKSCAPE_PROFILE_DIR"):
        return Path(profile, "extensions")
    if found := shutil.which("inkscape"):
        try:
            told = subprocess.run(
                [found, "--user-data-directory"], capture_output=True, text=True, timeout=PATIENCE
            ).stdout.strip()
        except (OSError, subprocess.SubprocessError):
            told = ""
        if told:
            return Path(told.splitlines()[-1], "extensions")
    home = Path.home()
    if sys.platform == "win32":
        return Path(os.environ.get("APPDATA", home / "AppData" / "Roaming"), "inkscape", "extensions")
    if sys.platform == "darwin":
        application = home / "Library" / "Application Support" / "org.inkscape.Inkscape"
        return application / "config" / "inkscape" / "extensions"
    return Path(os.environ.get("XDG_CONFIG_HOME", home / ".config"), "inkscape", "extensions")


def install(folder: str | None) -> list[Path]:
    """Write the extension into a folder, or into the one where Inkscape looks for it; return the files."""
    target = Path(folder) if folder is not None else folder_of_extensions()
    contents = {target / name: text for name, text in files().items()}
    check_targets(contents, [], force=True)
    write_files(contents, force=True)
    return list(contents)
