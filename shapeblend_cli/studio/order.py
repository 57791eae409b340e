"""What a process of the studio is asked to do."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from shapeblend_cli.batch.project import Project


class Order(NamedTuple):
    """Something to do with a project, and the drawings that were dropped into the page, by name."""

    what: str  # of `work.ORDERS`
    project: Project
    sources: Mapping[str, bytes]
    force: bool = False  # whether files are replaced
