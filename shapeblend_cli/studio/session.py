"""What the page asks for: the state of a studio, and answers to requests, values for JSON."""

from __future__ import annotations

import io
import os
import secrets
import shlex
import threading
import zipfile
from collections.abc import Mapping
from typing import Any, NamedTuple

from shapeblend_cli.errors import OptionError, ShapeblendError
from shapeblend_cli.job.job import RECORDS
from shapeblend_cli.options.easing import CURVES, NAMES
from shapeblend_cli.options.fields import Option
from shapeblend_cli.options.triggers import CLICK, HOVER, LOAD
from shapeblend_cli.options.types import FLAG
from shapeblend_cli.outputs.registry import DEFAULT, FORMATS, FRAME_FORMATS
from shapeblend_cli.rows.project import Project, parse_project, project_of, project_text, values_of
from shapeblend_cli.studio.order import Consent, Order
from shapeblend_cli.studio.process import Process
from shapeblend_cli.system.processes import MEGABYTES
from shapeblend_cli.system.write import check_targets, real_path, write_files
from shapeblend_cli.version import __version__

MOST_FILES = 64
"""Maximum number of drawings from the page."""

MOST_BYTES = 256 * 2**20
"""Maximum size of all drawings from the page together, in bytes."""

SECONDS = 60.0
"""Time limit of a blend without --timeout, in seconds."""

SPRING = "spring(1,180,12)"
"""A spring to begin with, whose numbers people change."""

EPOCH = (1980, 1, 1, 0, 0, 0)  # of files in an archive, whose bytes are to depend on nothing but the files


class Download(NamedTuple):
    """A file for the browser to keep."""

    name: str
    content: bytes


class Session:
    """Drawings, and processes that blend them: one for the page's live blend, another for longer work."""

    def __init__(self, project: Project, folder: str = "") -> None:
        self.project = project
        self._folder = os.path.abspath(folder)  # where files are written unasked
        self._given: dict[str, bytes] = {}  # drawings that were dropped into the page
        self._opened = set(project.files)
        self._saved = project
        self._written: dict[str, str] = {}  # projects as they were saved here, by their real paths
        self._name = secrets.token_hex(8)  # which says nothing, and is of no other session
        self._lock = threading.Lock()
        self._seconds = float(project.given.get("timeout") or SECONDS)
        self._megabytes = float(project.given.get("max_memory") or MEGABYTES)
        self._live, self._slow = Process(), Process()
        self._has_blended = False

    def start(self) -> None:
        """Start the processes, so that nothing waits for them. The slow one would delay the first blend, and waits."""
        self._live.warm_up()
        if self._has_blended:
            self._slow.warm_up()

    def stop(self) -> None:
        """End the processes."""
        self._live.close()
        self._slow.close()

    # ---- requests

    def begin(self, _: Mapping[str, Any]) -> dict[str, Any]:
        """Return what the page begins with."""
        return {
            "version": __version__,
            "session": self._name,
            "project": values_of(self.project),
            "is_saved": self.is_saved,
            "dropped": [name for name, content in self._given.items() if not _is_file(name, content)],
            "folder": os.getcwd(),
            "formats": [_format(format) for format in sorted(FORMATS, key=lambda one: not one.plays)],
            "options": [
                _option(field)
                for record in RECORDS
                for name, field in record.options.items()
                if name != "force"
            ],
            "words": {"ease": [*NAMES, *CURVES, SPRING], "trigger": [LOAD, CLICK, HOVER]},
            "default": DEFAULT,
        }

    @property
    def is_saved(self) -> bool:
        """Whether the project is as it was opened, or saved last."""
        return self.project == self._saved

    def take_drawing(self, name: str, content: bytes) -> dict[str, Any]:
        """Take a drawing that was dropped into the page; return its name here, which no other drawing has."""
        name = _plain_name(name)
        with self._lock:
            if (
                len(self._given) >= MOST_FILES
                or len(content) + sum(map(len, self._given.values())) > MOST_BYTES
            ):
                raise OptionError(f"{name}: more drawings than the studio keeps; a new studio would take it")
            stem, suffix = os.path.splitext(name)
            for number in range(1, MOST_FILES + 2):
                name = f"{stem}-{number}{suffix}" if number > 1 else name
                if self._given.get(name) == content:
                    break
                if name not in self._given and (name not in self._opened or _is_file(name, content)):
                    break
            if name not in self._opened or not _is_file(name, content):
                self._given[name] = content
        return {"name": name, "is_here": _is_file(name, content)}

    def take_project(self, name: str, content: bytes) -> dict[str, Any]:
        """Take a project that was dropped into the page, whose drawings are open here or were dropped, too."""
        project = parse_project(content, _plain_name(name), "")
        return {"project": values_of(project._replace(files=tuple(map(self._known, project.files))))}

    def look(self, asked: Mapping[str, Any]) -> dict[str, Any]:
        """Return a blend to look at, and the command line that makes it; keep the present project."""
        project = self._project(asked)
        if asked.get("is_present"):  # not one that is tried
            self.project = project
            self._saved = project if asked.get("is_saved") else self._saved
        found = self._with_command(project, lambda: self._ask(self._live, self._order("blend", project)))
        if not self._has_blended and "error" not in found:
            self._has_blended = True
            self._slow.warm_up()
        return found

    def others(self, asked: Mapping[str, Any]) -> dict[str, Any]:
        """Return other blends of the two drawings, to choose from."""
        order = self._order("others", self._project(asked))
        return {"others": self._ask(self._slow, order)}

    def size(self, asked: Mapping[str, Any]) -> dict[str, Any]:
        """Return how many files would be written, and how large they would be."""
        size: dict[str, Any] = self._ask(self._slow, self._order("size", self._project(asked)), 10)
        return size

    def write(self, asked: Mapping[str, Any]) -> dict[str, Any]:
        """Write what the command line writes, where it does, or return what to ask before that."""
        order = self._order("write", self._project(asked))
        return self._ask(self._slow, order._replace(consent=self._consent(asked)), 10)

    def download(self, asked: Mapping[str, Any]) -> Download:
        """Return what the command line would write: a file, or an archive of several."""
        project = self._project(asked)
        files = self._ask(self._slow, self._order("contents", project), 10)["files"]
        if len(files) == 1:
            ((name, content),) = files.items()
            return Download(os.path.basename(name), content)
        return Download(f"{DEFAULT}.zip", _archive(files))

    def save(self, asked: Mapping[str, Any]) -> dict[str, Any]:
        """Write the project into a file, or return what to ask before that: not about one that was written here."""
        from pathlib import Path

        target = Path(_text(asked, "file"))
        if target.suffix.lower() != ".json":
            raise OptionError(f"{target}: the name of a project ends in .json")
        project, consent = self._project(asked), self._consent(asked)
        name = real_path(target)
        if name in self._written and _is_file(name, self._written[name].encode()):
            consent = consent._replace(agreed=consent.agreed | {name})
        asks = consent.asks([target])
        if any(asks.values()):
            return {"asks": asks}
        force = os.path.lexists(target)
        check_targets([target], [], force)
        text = project_text(project, str(target.parent))
        write_files({target: text}, force)
        self._written[name] = text
        return {"written": [str(target)], "notes": []}

    def keep(self, asked: Mapping[str, Any]) -> Download:
        """Return the project as a file for the browser to keep, beside the drawings."""
        project = self._project(asked)
        files = tuple(map(os.path.basename, project.files))
        return Download(f"{DEFAULT}.json", project_text(project._replace(files=files), "").encode())

    def here(self, _: Mapping[str, Any]) -> dict[str, Any]:
        """Answer the page's sign that it is still open."""
        return {}

    def halt(self, _: Mapping[str, Any]) -> dict[str, Any]:
        """Stop the blend that is being made."""
        self._live.stop("stopped")
        self._slow.stop("stopped")
        self.start()
        return {}

    # ---- parts

    def _project(self, asked: Mapping[str, Any]) -> Project:
        values = asked.get("project")
        if not isinstance(values, Mapping):
            raise OptionError("the page sent no project; loading it again would help")
        project = project_of(values, "the project", "")
        return project._replace(files=tuple(map(self._known, project.files)))

    def _consent(self, asked: Mapping[str, Any]) -> Consent:
        agreed = asked.get("agreed", [])
        if not isinstance(agreed, list) or not all(isinstance(name, str) for name in agreed):
            raise OptionError("the page sent no names of files; loading it again would help")
        return Consent(self._folder, frozenset(agreed))

    def _known(self, name: str) -> str:
        """Return the name of a drawing that is open here; files that nobody opened are not read."""
        if name in self._given or name in self._opened:
            return name
        plain = os.path.basename(name)
        for one in (*self._given, *self._opened):
            if os.path.basename(one) == plain:
                return one
        raise OptionError(f"{plain}: not open here; dropping it into the page, too, would help")

    def _ask(self, process: Process, order: Order, times: int = 1) -> Any:
        """Have an order done, which may take so many times as long as a blend."""
        return process.ask(order, times * self._seconds, self._megabytes)

    def _order(self, what: str, project: Project) -> Order:
        sources = {name: self._given[name] for name in project.files if name in self._given}
        return Order(what, project, sources)

    def _with_command(self, project: Project, work: Any) -> dict[str, Any]:
        """Return what comes of some work, or why it failed; in any case with the command line."""
        command = {"command": shlex.join(project.command)}
        try:
            return command | work()
        except ShapeblendError as error:
            return command | {"error": str(error)}


def _format(format: Any) -> dict[str, Any]:
    options: dict[str, str] = {}
    if format.emit != "frames":
        options["emit"] = format.emit
    if format.has_frame_files and format.name != FRAME_FORMATS[0]:
        options["format"] = format.name
    return {
        "name": format.name,
        "help": format.help,
        "suffix": format.suffix,
        "options": options,
        "takes": {name: "" if value is None else str(value) for name, value in format.defaults.items()}
        | ({"lossless": ""} if format.name == "webp" else {}),
        "takes_triggers": format.takes_triggers,
        "is_raster": "fps" in format.defaults,
        "has_frames": format.has_frame_files or format.takes_times or "fps" in format.defaults,
    }


def _option(field: Option) -> dict[str, Any]:
    yes, _, no = field.flags[-1].partition("/")
    kind = "text"
    if field.kind is FLAG:
        kind = "flag"
    elif field.kind.choices:
        kind = "choice"
    elif field.kind.split in (int, float):
        kind = "number"
    return {
        "name": yes.lstrip("-"),
        "no": no.lstrip("-"),
        "section": field.section,
        "help": field.help,
        "kind": kind,
        "is_whole": field.kind.split is int,
        "is_file": field.kind.is_file,
        "many": field.many,
        "choices": list(field.kind.choices),
        "metavar": field.metavar,
        "default": field.shown_default or ("0" if isinstance(field.default, float) else ""),
    }


def _text(asked: Mapping[str, Any], name: str) -> str:
    value = asked.get(name)
    if not isinstance(value, str) or not value or "\0" in value:
        raise OptionError("the name of a file is missing")
    return value


def _plain_name(name: str) -> str:
    """Return the name of a file that was dropped, without a folder, and such that no command takes it for an option."""
    plain = os.path.basename(name.replace("\\", "/").replace("\0", ""))[-200:]
    plain = "".join(c for c in plain if c.isprintable()).lstrip("-") or "drawing.svg"
    return plain if plain.lower() not in (".", "..") else "drawing.svg"


def _is_file(name: str, content: bytes) -> bool:
    """Return whether a file is where the command line would look for it, with these contents."""
    try:
        with open(name, "rb") as stream:
            return stream.read(len(content) + 1) == content
    except (OSError, ValueError):
        return False


def _archive(files: Mapping[str, bytes]) -> bytes:
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            inside = os.path.normpath(name).replace(os.sep, "/").lstrip("/")
            while inside.startswith("../"):
                inside = inside[3:]
            archive.writestr(zipfile.ZipInfo(inside, EPOCH), content, zipfile.ZIP_DEFLATED)
    return stream.getvalue()
