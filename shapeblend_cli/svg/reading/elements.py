"""The elements of SVG by what they do to a drawing."""

from __future__ import annotations

POINT_LISTS = frozenset(("path", "polyline", "polygon"))

SHAPES = POINT_LISTS | {"rect", "circle", "ellipse", "line"}

GROUPS = frozenset(("g", "a", "switch", "svg", "use"))
"""What draws what stands in it, or what it refers to."""

LEFT_OUT = frozenset(("text", "image", "foreignObject", "video", "canvas", "iframe"))
"""What browsers draw and this reader does not."""
