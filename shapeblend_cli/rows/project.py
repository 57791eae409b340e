"""A project: drawings and options in a JSON file, by the names that they have in a line of a batch.

``{"files": ["hen.svg", "pecking.svg"], "pin": ["4,9:5,8"], "duration": 1.5}``. Files are relative to its folder.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, NamedTuple

from shapeblend_cli.errors import InputError, OptionError, unreadable
from shapeblend_cli.options.types import FLAG
from shapeblend_cli.rows.manifest import once
from shapeblend_cli.rows.row import LETTERS, Name, command_of, fields_of, plain_number, row_of, typed
from shapeblend_cli.system.write import is_inside

MAX_BYTES = 4 * 2**20
"""Maximum size of a project, in bytes. Whatever is larger is another file."""


class Project(NamedTuple):
    """Drawings to blend, and the options of the blend."""

    files: tuple[str, ...]
    given: Mapping[str, Any]  # values of options by the names of their fields

    def with_given(self, given: Mapping[str, Any]) -> Project:
        """Return the project with options that were given beside it, which count more."""
        beside = {name: value for name, value in given.items() if value not in (None, ())}
        return self._replace(given={**self.given, **beside})

    @property
    def command(self) -> tuple[str, ...]:
        """The command line that does the same."""
        return command_of(self.files, self.given)


def read_project(file: str) -> Project:
    """Read a project.

    Raises
    ------
    InputError
        If the file cannot be read.
    OptionError
        If it is no project, or says what no option can be.
    """
    try:
        with open(file, "rb") as stream:
            data = stream.read(MAX_BYTES + 1)
    except (OSError, ValueError) as error:
        raise unreadable(file, error, "project") from None
    if len(data) > MAX_BYTES:
        raise InputError(file, f"larger than {MAX_BYTES // 2**20} MB, the most that a project has")
    return parse_project(data, file, os.path.dirname(file))


def check_outputs(project: Project, file: str, beside: Mapping[str, Any]) -> None:
    """Raise OptionError for a file that a project would write outside its folder, unless `beside` names it."""
    folder = os.path.dirname(file) or os.curdir
    for field, value in fields_of(project.given):
        if field.kind.is_file and value != "-" and beside.get(field.name) in (None, ()):
            if not is_inside(Path(value), folder):
                raise OptionError(
                    f"{file}: {value} lies outside the folder of the project; {field.flags[-1]} {value} on the command "
                    "line would write there"
                )


def parse_project(data: bytes, where: str, base: str) -> Project:
    """Return the project that a text of JSON is, with files relative to `base`; see `read_project` for errors."""
    import json

    form = 'a project such as {"files": ["a.svg", "b.svg"], "duration": 1.5} would work'
    try:
        values = json.loads(data.decode("utf-8-sig"), object_pairs_hook=once)
    except UnicodeDecodeError:
        raise OptionError(f"{where}: not UTF-8; {form}") from None
    except (ValueError, RecursionError) as error:
        raise OptionError(f"{where}: not JSON ({error}); {form}") from None
    if not isinstance(values, dict):
        raise OptionError(f"{where}: not a JSON object; {form}")
    if not values.keys() & {"files", *LETTERS}:
        kind = "a Lottie animation" if {"layers", "v"} <= values.keys() else "a JSON file without drawings"
        raise OptionError(f"{where}: {kind}, not a project of shapeblend; {form}")
    return project_of(values, where, base)


def project_of(values: Mapping[str, Any], where: str, base: str) -> Project:
    """Return the project that the values of a JSON object make; see `read_project` for errors."""
    row = row_of(values, where, base)
    given = {
        name: os.path.join(value.base, value.pattern) if isinstance(value, Name) else value
        for name, value in row.given.items()
    }
    return Project(row.files, given)


def values_of(project: Project) -> dict[str, Any]:
    """Return the values of the JSON object that a project is, as they are typed on the command line."""
    values: dict[str, Any] = {"files": list(project.files)}
    for field, value in fields_of(project.given):
        yes, _, no = field.flags[-1].partition("/")
        if field.kind is FLAG:
            values[(yes if value or not no else no).lstrip("-")] = bool(value) or bool(no)
        elif field.many:
            values[yes.lstrip("-")] = [typed(one) for one in value]
        else:
            plain = isinstance(value, int | float) and not isinstance(value, bool)
            values[yes.lstrip("-")] = plain_number(value) if plain else typed(value)
    return values


def project_text(project: Project, folder: str) -> str:
    """Return the text of a project that is written to a folder, with names of files relative to it."""
    import json

    def relative(file: str) -> str:
        if os.path.isabs(file):
            return file
        return os.path.relpath(file, folder or os.curdir).replace(os.sep, "/")

    given = dict(project.given)
    for field, value in fields_of(project.given):
        if field.kind.is_file and value != "-":
            given[field.name] = relative(value)
    files: Iterable[str] = map(relative, project.files)
    values = values_of(Project(tuple(files), given))
    return json.dumps(values, ensure_ascii=False, indent=2, allow_nan=False) + "\n"
