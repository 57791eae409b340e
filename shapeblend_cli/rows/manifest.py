"""Rows of a manifest: JSON lines, CSV or TOML."""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Iterator
from typing import Any

from shapeblend_cli.errors import OptionError, unreadable
from shapeblend_cli.job.job import STANDARD_INPUT
from shapeblend_cli.rows.row import Row, check_names, options_of, row_of

KINDS = (".jsonl", ".ndjson", ".csv", ".toml")


def read_manifest(file: str) -> tuple[list[Row], dict[str, Any]]:
    """Read a manifest, and return its rows and what holds for all that do not say otherwise.

    Standard input, named `-`, has JSON lines.

    Raises
    ------
    OptionError
        If a row cannot be read, with its line.
    InputError
        If the manifest itself cannot be read.
    """
    if os.path.isdir(file):
        raise OptionError(
            f"{file}: is a folder, not a manifest; --chain {file} would blend each drawing in it with the next one, "
            f"and --pairs {file} OTHER those of two folders that have one name"
        )
    if not is_manifest(file):
        raise OptionError(f"{file}: a manifest ends in .jsonl, .csv or .toml, or is - for JSON lines")
    is_standard_input = file == STANDARD_INPUT
    kind = ".jsonl" if is_standard_input else _suffix(file)
    name, base = ("<stdin>", "") if is_standard_input else (file, os.path.dirname(file))
    text = _text(file, name)
    defaults: dict[str, Any] = {}
    if kind == ".toml":
        rows, defaults = _toml(text, name, base)
    else:
        found = _csv(text, name) if kind == ".csv" else _json_lines(text, name)
        rows = [row_of(values, where, base) for where, values in found]
    if not rows:
        raise OptionError(f"{name}: no jobs found; it takes one")
    return rows, defaults


def is_manifest(file: str) -> bool:
    """Return whether a file is a manifest, by its name."""
    return file == STANDARD_INPUT or _suffix(file) in KINDS


def _suffix(file: str) -> str:
    return os.path.splitext(file)[1].lower()


def _text(file: str, name: str) -> str:
    try:
        if file == STANDARD_INPUT:
            data = sys.stdin.buffer.read() if sys.stdin is not None else b""
        else:
            with open(file, "rb") as stream:
                data = stream.read()
        return data.decode("utf-8-sig")
    except OSError as error:
        raise unreadable(name, error, "manifest") from None
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        raise OptionError(f"{name}, line {line}: not UTF-8") from None


def _json_lines(text: str, name: str) -> Iterator[tuple[str, dict[str, Any]]]:
    import json

    for number, line in enumerate(text.split("\n"), 1):
        where = f"{name}, line {number}"
        if not line.strip():
            continue
        try:
            values = json.loads(line, object_pairs_hook=once)
        except (ValueError, RecursionError) as error:
            raise OptionError(f"{where}: not a JSON object ({error})") from None
        if not isinstance(values, dict):
            raise OptionError(f'{where}: not a JSON object such as {{"a": "1.svg", "b": "2.svg"}}')
        yield where, values


def once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """Return an object of JSON; ValueError if it has a key twice."""
    found = dict(pairs)
    if len(found) < len(pairs):
        raise ValueError("a key is given twice")
    return found


def _csv(text: str, name: str) -> Iterator[tuple[str, dict[str, Any]]]:
    import csv

    reader = csv.reader(text.splitlines(keepends=True), strict=True)
    header: list[str] | None = None
    begin = 1
    try:
        for cells in reader:
            where, begin = f"{name}, line {begin}", reader.line_num + 1
            if not any(map(str.strip, cells)):
                continue
            if header is None:
                header = [cell.strip() for cell in cells]
                if len({*header}) < len(header):
                    raise OptionError(f"{where}: two columns have the same name")
                if len(header) == 1 and ";" in header[0]:
                    raise OptionError(f"{where}: {header[0]} has no commas; a,b,o would work, as CSV")
                check_names(header, where)
                continue
            if len(cells) > len(header):
                raise OptionError(f"{where}: {len(cells)} cells, and {len(header)} columns")
            yield where, {key: cell.strip() for key, cell in zip(header, cells, strict=False) if cell.strip()}
    except csv.Error as error:
        raise OptionError(f"{name}, line {begin}: {error}") from None


def _toml(text: str, name: str, base: str) -> tuple[list[Row], dict[str, Any]]:
    import tomllib

    try:
        found = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise OptionError(f"{name}: {error}") from None
    jobs, defaults = found.pop("job", []), found.pop("defaults", {})
    if found:
        raise OptionError(f"{name}: {min(found)!r} is unknown; [defaults] and [[job]] would work")
    if not isinstance(defaults, dict) or not isinstance(jobs, list):
        raise OptionError(
            f"{name}: jobs are written as [[job]], and what applies to all of them as [defaults]"
        )
    lines = [text.count("\n", 0, m.start()) + 1 for m in re.finditer(r"^[ \t]*\[\[ *job *\]\]", text, re.M)]
    rows = []
    for k, values in enumerate(jobs):
        # The library gives no lines; tables inside texts, or none, would make these wrong.
        where = f"{name}, line {lines[k]}" if len(lines) == len(jobs) else f"{name}, job {k + 1}"
        if not isinstance(values, dict):
            raise OptionError(f'{where}: not a table such as {{a = "1.svg", b = "2.svg"}}')
        rows.append(row_of(values, where, base))
    return rows, options_of(defaults, f"{name}, [defaults]", base)
