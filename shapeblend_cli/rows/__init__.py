"""Blends as they are asked for outside the command line: rows of manifests, folders of drawings, projects."""

from __future__ import annotations

SUFFIX = ".json"
"""Suffix of projects."""


def is_project(file: str) -> bool:
    """Return whether a file is a project, by its name."""
    return file.lower().endswith(SUFFIX)
