"""Affine maps, and the ``transform`` attribute and properties that give them."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, NamedTuple

from shapeblend_cli.svg.xml.units import BLANK, GAP, KEYWORDS, LIMIT, NUMBER, Lengths, length

if TYPE_CHECKING:
    from shapeblend_cli.model import Box, ComplexArray
    from shapeblend_cli.svg.xml.messages import Notes
    from shapeblend_cli.svg.xml.xmltree import Node

SINGLE = ("translate", "rotate", "scale")
"""CSS properties that come before ``transform``, in this order."""

_TRANSFORMS = frozenset(("transform", *SINGLE))

# Left as text: `re` compiles them when the first transform is read.
_CALL = rf"{GAP}([a-zA-Z0-9]++){BLANK}*+\(([^()]*+)\)"
_ARGUMENT = rf"{GAP}({NUMBER})([a-zA-Z%]*+)"
_ORIGINS = {"left": "0%", "top": "0%", "center": "50%", "right": "100%", "bottom": "100%"}
_MAX_LENGTH = 10_000
_ANGLES = {"": 1.0, "deg": 1.0, "rad": 180.0 / math.pi, "grad": 0.9, "turn": 360.0}


class Affine(NamedTuple):
    """The affine map of ``(x, y)`` to ``(a x + c y + e, b x + d y + f)``; by default the identity."""

    a: float = 1.0
    b: float = 0.0
    c: float = 0.0
    d: float = 1.0
    e: float = 0.0
    f: float = 0.0

    def __matmul__(self, first: Affine) -> Affine:
        """Return the map that applies `first`, then this one."""
        a, b, c, d, e, f = self
        p, q, r, s, t, u = first
        linear = a * p + c * q, b * p + d * q, a * r + c * s, b * r + d * s
        return Affine(*linear, a * t + c * u + e, b * t + d * u + f)

    def points(self, z: ComplexArray) -> ComplexArray:
        """Map points."""
        a, b, c, d, e, f = self
        linear = z * complex(a + d, b - c) / 2
        if a != d or b != -c:
            linear = linear + z.conj() * complex(a - d, b + c) / 2
        return linear + complex(e, f)

    @property
    def determinant(self) -> float:
        """The factor that scales areas."""
        return self.a * self.d - self.b * self.c

    def about(self, x: float, y: float) -> Affine:
        """Return this map with ``(x, y)`` as its origin."""
        return translation(x, y) @ self @ translation(-x, -y)


IDENTITY = Affine()


def translation(x: float, y: float = 0.0) -> Affine:
    """Return the map that moves by ``(x, y)``."""
    return Affine(1.0, 0.0, 0.0, 1.0, x, y)


def onto(box: Box) -> Affine:
    """Return the map of the unit square onto a box."""
    return Affine(box.width, 0.0, 0.0, box.height, box.x, box.y)


def rotation(angle: float, *centre: float) -> Affine:
    """Return the rotation by an angle in radians about the origin, or about ``(x, y)``."""
    cos, sin = math.cos(angle), math.sin(angle)
    turn = Affine(cos, sin, -sin, cos)
    return turn.about(*centre) if centre else turn


def is_sound(matrix: Affine) -> bool:
    """Return whether every entry is finite and below the limit on numbers."""
    return all(abs(entry) < LIMIT for entry in matrix)


_FUNCTIONS: dict[str, tuple[str, tuple[int, ...], Callable[..., Affine]]] = {
    "matrix": ("nnnnnn", (6,), Affine),
    "translate": ("xy", (1, 2), translation),
    "translatex": ("x", (1,), translation),
    "translatey": ("y", (1,), lambda y: translation(0.0, y)),
    "scale": ("ss", (1, 2), lambda x, y=None: Affine(a=x, d=x if y is None else y)),
    "scalex": ("s", (1,), lambda x: Affine(a=x)),
    "scaley": ("s", (1,), lambda y: Affine(d=y)),
    "rotate": ("ann", (1, 3), rotation),
    "skew": ("aa", (1, 2), lambda x, y=0.0: Affine(b=math.tan(y), c=math.tan(x))),
    "skewx": ("a", (1,), lambda x: Affine(c=math.tan(x))),
    "skewy": ("a", (1,), lambda y: Affine(b=math.tan(y))),
}
"""Transform functions by name: the kinds of their arguments, their possible numbers, and the map.

Kinds are n for numbers, s for numbers or percentages, a for angles, x and y for horizontal and vertical lengths.
"""


def _rotation_3d(x: float, y: float, z: float, angle: float) -> Affine:
    """Return the rotation about an axis in space, seen from the front."""
    size = math.hypot(x, y, z)
    if size == 0.0:
        return IDENTITY
    x, y, z = x / size, y / size, z / size
    cos, sin = math.cos(angle), math.sin(angle)
    rest = 1.0 - cos
    return Affine(cos + x * x * rest, x * y * rest + z * sin, x * y * rest - z * sin, cos + y * y * rest)


_IN_SPACE: dict[str, tuple[str, tuple[int, ...], Callable[..., Affine]]] = {
    "translate3d": ("xyx", (3,), lambda x, y, z: translation(x, y)),
    "translatez": ("x", (1,), lambda z: IDENTITY),
    "scale3d": ("sss", (3,), lambda x, y, z: Affine(a=x, d=y)),
    "scalez": ("s", (1,), lambda z: IDENTITY),
    "rotatex": ("a", (1,), lambda angle: _rotation_3d(1.0, 0.0, 0.0, angle)),
    "rotatey": ("a", (1,), lambda angle: _rotation_3d(0.0, 1.0, 0.0, angle)),
    "rotatez": ("a", (1,), rotation),
    "rotate3d": ("nnna", (4,), _rotation_3d),
    "matrix3d": (16 * "n", (16,), lambda *m: Affine(m[0], m[1], m[4], m[5], m[12], m[13])),
    "perspective": ("x", (1,), lambda distance: IDENTITY),
}
"""Functions that only the CSS property has, in the same form: what is left of them in a drawing, which is flat.

Of a list, each is flattened by itself: turns out of the plane that follow each other, depth after such
a turn, and perspective differ from browsers.
"""

_IN_CSS = _FUNCTIONS | _IN_SPACE


def parse(text: str, viewport: Lengths | None = None) -> Affine | None:
    """Read a list of transform functions, or ``none``; return None when `text` is neither.

    The `viewport` is given for the CSS property. Its lengths and angles need units, those of the attribute must have
    none.
    """
    text = text.strip()
    if text in ("", "none"):
        return IDENTITY
    calls = _split(_CALL, text) if len(text) <= _MAX_LENGTH else []
    result = IDENTITY
    for call in calls:
        step = _function(call[1].lower(), call[2], viewport)
        if step is None:
            return None
        result = result @ step
    return result if calls else None


def _split(pattern: str, text: str) -> list[re.Match[str]]:
    """Return the matches that make up a text; none if there is anything else in it."""
    compiled = re.compile(pattern)
    matches: list[re.Match[str]] = []
    end = 0
    while match := compiled.match(text, end):
        matches.append(match)
        end = match.end()
    return [] if text.lstrip().startswith(",") or text[end:].strip() else matches


def _function(name: str, text: str, viewport: Lengths | None) -> Affine | None:
    """Return the map of one function: https://www.w3.org/TR/css-transforms-1/#two-d-transform-functions."""
    arguments = [(float(match[1]), match[2].lower()) for match in _split(_ARGUMENT, text)]
    known = _FUNCTIONS if viewport is None else _IN_CSS
    kinds, counts, affine = known.get(name, ("", (), Affine))
    if len(arguments) not in counts or not all(abs(value) < LIMIT for value, _ in arguments):
        return None
    # Only the attribute's rotate() takes a centre.
    if any(unit for _, unit in arguments) if viewport is None else name == "rotate" and len(arguments) == 3:
        return None
    values = [_argument(kind, *argument, viewport) for kind, argument in zip(kinds, arguments, strict=False)]
    return None if None in values else affine(*values)


def angle(text: str) -> float | None:
    """Return an angle, in degrees or with a unit, in radians; None if it cannot be read."""
    arguments = [(float(match[1]), match[2].lower()) for match in _split(_ARGUMENT, text)]
    if len(arguments) != 1 or not abs(arguments[0][0]) < LIMIT:
        return None
    return _argument("a", *arguments[0], None)


def _argument(kind: str, value: float, unit: str, viewport: Lengths | None) -> float | None:
    """Return an argument of some kind in user units or radians, or None when it is of another."""
    if kind in "xya" and viewport is not None and not unit and value:
        return None
    if kind == "x" or kind == "y":
        whole = None if viewport is None else viewport.width if kind == "x" else viewport.height
        return length(f"{value!r}{unit}", whole)
    if kind == "a":
        return math.radians(value * _ANGLES[unit]) if unit in _ANGLES else None
    if kind == "s" and unit == "%":
        return value / 100
    return None if unit else value


def origin(text: str, lengths: Lengths) -> tuple[float, float]:
    """Return the point ``transform-origin`` names; (0, 0), the default, when it cannot be read."""
    words = text[:_MAX_LENGTH].lower().split()[:2]
    if words and (words[0] in ("top", "bottom") or words[1:] in (["left"], ["right"])):
        words = [*words[1:], words[0]]
        if len(words) == 1:
            words.insert(0, "center")
    horizontal, vertical = (_ORIGINS.get(word, word) for word in (*words, "center", "center")[:2])
    x, y = lengths.x(horizontal), lengths.y(vertical)
    return (0.0, 0.0) if x is None or y is None else (x, y)


def _is_none(text: str) -> bool:
    """Return whether a value of CSS stands for no transform."""
    return text.strip().lower() in {"none", *KEYWORDS}


def transform_of(
    node: Node,
    declared: Mapping[str, str],
    lengths: Lengths,
    notes: Notes,
    box: Callable[[], Box | None] = lambda: None,
) -> Affine:
    """Return the transform that an element declares; the identity, with a note, if it cannot be read.

    `box` finds the box around it in its own coordinates, if that is known.
    """
    if _TRANSFORMS.isdisjoint(declared):
        return IDENTITY
    kind = declared.get("transform-box", "view-box").strip().lower()
    around = box() if kind in ("fill-box", "content-box") else None
    if around is not None:
        lengths = lengths._replace(width=around.width, height=around.height)
    text = declared.get("transform", "none")
    text = "none" if _is_none(text) else text
    # The two have different grammars; a property that wins is not the attribute's string.
    matrix = parse(text, None if text is node.get("transform") else lengths)
    steps = [f"{name}({declared[name]})" for name in SINGLE if not _is_none(declared.get(name, "none"))]
    first = parse(" ".join(steps), lengths)
    if matrix is None or first is None:
        notes.add("a transform that cannot be read is not applied")
        return IDENTITY
    matrix = first @ matrix
    if matrix == IDENTITY:
        return matrix
    if around is None and kind not in ("view-box", "border-box"):
        notes.add("transform-box read as view-box")
    if around is None and "transform-origin" not in declared:
        return matrix
    x, y = origin(declared.get("transform-origin", "0 0"), lengths)
    return matrix.about(x, y) if around is None else matrix.about(around.x + x, around.y + y)
