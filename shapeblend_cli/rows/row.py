"""A row: one job of a batch as it was asked for. Its options are those of the command line, by the same names."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping
from functools import cache
from typing import Any, NamedTuple

from shapeblend_cli.errors import OptionError
from shapeblend_cli.job.job import RECORDS
from shapeblend_cli.options.fields import Option
from shapeblend_cli.options.types import FLAG

LETTERS = "abcdefghijklm"
"""Names of a row's files, in order; `n` and `o` mean something else."""

YES, NO = ("true", "yes", "1"), ("false", "no", "0")

SEPARATOR = ";"  # between the values of a repeatable option in a text


class Name(NamedTuple):
    """The name of a file to write, perhaps with fields such as `{a}`, and the folder that it is relative to."""

    pattern: str
    base: str = ""
    is_bound: bool = (
        False  # whether it has to stay in that folder, as a file says it and not the command line
    )


class Row(NamedTuple):
    """One job as it was asked for."""

    where: str  # for errors: the file and the line
    files: tuple[str, ...]
    name: str  # of the first file, relative to where the batch looked for it
    given: Mapping[
        str, Any
    ]  # values of options by the names of their fields, those that name files as `Name`


def row_of(values: Mapping[str, Any], where: str, base: str) -> Row:
    """Make a row of the values in a manifest, with paths relative to `base`; values of None count as missing.

    Raises
    ------
    OptionError
        If there is a key that is no option, a value that an option cannot have, or no drawing.
    """
    values = {key: value for key, value in values.items() if value is not None}
    files = values.pop("files", None)
    letters = [letter for letter in LETTERS if letter in values]
    named = [values.pop(letter) for letter in letters]
    if files is None:
        if "".join(letters) != LETTERS[: len(letters)] or len(letters) < 2:
            given = f"{' and '.join(letters)} alone" if letters else "none"
            raise OptionError(
                f"{where}: a job has drawings a and b, and further ones c, d ...; {given} given"
            )
        files = named
    elif named:
        raise OptionError(f"{where}: files stands for a, b and so on; give one or the other")
    if isinstance(files, str) or not isinstance(files, Iterable):
        raise OptionError(f"{where}: files must be a list of names, not {files!r}")
    files = list(files)
    if not files:
        raise OptionError(f"{where}: a job has drawings a and b, and further ones c, d ...; none given")
    for file in files:
        if not isinstance(file, str) or not file or file == "-":
            raise OptionError(f"{where}: a drawing must be the name of a file, not {file!r}")
    name = os.path.normpath(files[0])
    if os.path.isabs(name) or name.startswith(os.pardir):
        name = os.path.basename(name)
    return Row(
        where, tuple(os.path.join(base, file) for file in files), name, options_of(values, where, base)
    )


def options_of(values: Mapping[str, Any], where: str, base: str) -> dict[str, Any]:
    """Return the values of options by the names of their fields, read as on the command line."""
    given: dict[str, Any] = {}
    for key, value in values.items():
        field, meaning = _option(key, where)
        if field.name == "force":
            raise OptionError(
                f"{where}: force replaces files, and only the command line can say it: --force would work there"
            )
        if field.name in given:
            raise OptionError(f"{where}: {key} is given twice")
        if field.kind.is_read and isinstance(value, str) and not value.lstrip().startswith("{"):
            value = os.path.join(base, value)
        try:
            given[field.name] = _value(field, value, meaning)
        except ValueError as error:
            raise OptionError(f"{where}: {key} {error}") from None
        if field.kind.is_file:
            given[field.name] = Name(given[field.name], base, is_bound=True)
    return given


def named(values: Mapping[str, Any]) -> dict[str, Any]:
    """Return the values of fields that jobs have, with names of files relative to the working folder."""
    fields = {name: field for record in RECORDS for name, field in record.options.items() if name in values}
    return {n: Name(values[n]) if field.kind.is_file else values[n] for n, field in fields.items()}


def command_of(files: Iterable[str], given: Mapping[str, Any]) -> tuple[str, ...]:
    """Return the command line that does a job alone; names of files are texts."""
    words = ["shapeblend", *files]
    for field, value in fields_of(given):
        yes, _, no = field.flags[-1].partition("/")
        if field.kind is FLAG:
            words += [flag for flag in [yes if value else no] if flag]
            continue
        for one in value if field.many else (value,):
            words += [yes, typed(one)]
    return tuple(words)


def fields_of(given: Mapping[str, Any]) -> Iterator[tuple[Option, Any]]:
    """Yield the options of a job that are given, with their values, in the order of help; replacing files is none."""
    for record in RECORDS:
        for name, field in record.options.items():
            value = given.get(name)
            if value is not None and name != "force":
                yield field, value


def typed(value: Any) -> str:
    """Return a value as it is typed on the command line."""
    if isinstance(value, complex):
        return f"{plain_number(value.real)},{plain_number(value.imag)}"
    if isinstance(value, float):
        return str(plain_number(value))
    # An easing, a timetable and a trigger are tuples that have a text of their own.
    if type(value) is not tuple:
        return str(value)
    parts = [typed(part) for part in value]
    if isinstance(value[0], complex):  # points of A and of B, or a region of A
        return ":".join(parts) if len(parts) == 2 else f"{parts[0]},{parts[1]}={parts[2]}"
    return ("=" if isinstance(value[0], str) else ",").join(parts)


def plain_number(number: float) -> float:
    """Return a number as people type it: 2 and not 2.0.

    >>> plain_number(2.0), plain_number(0.5), plain_number(1e300)
    (2, 0.5, 1e+300)
    """
    return int(number) if number == int(number) and abs(number) < 1e15 else number


def check_names(keys: Iterable[str], where: str) -> None:
    """Raise OptionError for a key that no row can have."""
    for key in keys:
        if key not in (*LETTERS, "files"):
            _option(key, where)


def _option(key: str, where: str) -> tuple[Option, bool]:
    """Return the option of a key and, if it is a flag, what true means."""
    try:
        return _names()[key.replace("_", "-")]
    except KeyError:
        import difflib  # only errors need it

        near = difflib.get_close_matches(key.replace("_", "-"), _names(), 1, 0.75)
        would = near[0] if near else "a, b, o, and long options such as frames"
        raise OptionError(f"{where}: {key!r} is no option of a job; {would} would work") from None


@cache
def _names() -> dict[str, tuple[Option, bool]]:
    """Return options by their names in rows: long ones, and o; for one that is a flag, with what true means."""
    names: dict[str, tuple[Option, bool]] = {}
    for record in RECORDS:
        for field in record.options.values():
            for flag in field.flags:
                yes, _, no = flag.partition("/")
                if yes.startswith("--") or yes == "-o":
                    names[yes.lstrip("-")] = field, True
                if no:
                    names[no.lstrip("-")] = field, False
    return names


def _value(field: Option, value: Any, meaning: bool) -> Any:
    """Return the value of an option as it is kept; texts are read as if they were typed."""
    if field.kind is FLAG:
        if isinstance(value, str) and value.lower() in (*YES, *NO):
            value = value.lower() in YES
        return field.kind.check(value) is meaning
    if not field.many:
        return _one(field, value)
    if isinstance(value, str):
        value = [part.strip() for part in value.split(SEPARATOR)]
    if not isinstance(value, list):
        raise ValueError(f"must be a list, not {value!r}")
    return tuple(_one(field, each) for each in value)


def _one(field: Option, value: Any) -> Any:
    return field.kind.parse(value) if isinstance(value, str) else field.kind.check(value)
