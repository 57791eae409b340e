"""rect, circle, ellipse, line, polyline and polygon into contours: https://www.w3.org/TR/SVG2/shapes.html."""

from __future__ import annotations

import itertools
import math
from typing import TYPE_CHECKING

from shapeblend_cli.svg.reading import contours

if TYPE_CHECKING:
    from shapeblend_cli.model import Contour

    Radii = tuple[float | None, float | None]


def rect(x: float, y: float, width: float, height: float, radii: Radii = (None, None)) -> Contour | None:
    """Return a rectangle, clockwise from its top left as browsers draw it; None when it has no area.

    Parameters
    ----------
    x, y, width, height : float
    radii : pair of float or None
        Of the corners; None is ``auto``, the other one.
    """
    if width <= 0 or height <= 0:
        return None
    rx, ry = _corner_radii(width, height, radii)
    right, bottom = x + width, y + height
    if rx == 0:
        corners = [complex(x, y), complex(right, y), complex(right, bottom), complex(x, bottom)]
        return polyline(corners, closed=True)
    segments: list[contours.Segment] = []
    straight: list[bool] = []
    sides = (
        (complex(x + rx, y), complex(right - rx, y), complex(right, y + ry), -math.pi / 2),
        (complex(right, y + ry), complex(right, bottom - ry), complex(right - rx, bottom), 0.0),
        (complex(right - rx, bottom), complex(x + rx, bottom), complex(x, bottom - ry), math.pi / 2),
        (complex(x, bottom - ry), complex(x, y + ry), complex(x + rx, y), math.pi),
    )
    for start, end, turned, angle in sides:
        corner = _elliptic(end, (rx, ry), angle, math.pi / 2)
        corner[-1] = (*corner[-1][:3], turned)
        segments += [contours.line(start, end), *corner]
        straight += [True] + [False] * len(corner)
    return contours.chain(segments, straight, closed=True)


def ellipse(cx: float, cy: float, rx: float, ry: float) -> Contour | None:
    """Return an ellipse, clockwise from its rightmost point; None when it has no area."""
    if rx <= 0 or ry <= 0:
        return None
    segments = _elliptic(complex(cx + rx, cy), (rx, ry), 0.0, 2 * math.pi)
    return contours.chain(segments, [False] * len(segments), closed=True)


def polyline(points: list[complex], closed: bool) -> Contour | None:
    """Return straight lines through `points`."""
    segments = [contours.line(p, q) for p, q in itertools.pairwise(points)]
    return contours.chain(segments, [True] * len(segments), closed)


def _elliptic(
    start: complex, radii: tuple[float, float], begin: float, angle: float
) -> list[contours.Segment]:
    """Return an arc that begins at `start`, where an upright ellipse has the angle `begin`."""
    rx, ry = radii
    centre = start - complex(rx * math.cos(begin), ry * math.sin(begin))
    return [
        (
            centre + complex(p.real * rx, p.imag * ry),
            centre + complex(q.real * rx, q.imag * ry),
            centre + complex(r.real * rx, r.imag * ry),
            centre + complex(s.real * rx, s.imag * ry),
        )
        for p, q, r, s in contours.circular(begin, angle)
    ]


def _corner_radii(width: float, height: float, radii: Radii) -> tuple[float, float]:
    """Return the radii in force: auto resolved, at most half a side, both zero or none."""
    given_x, given_y = (None if r is None or r < 0 else r for r in radii)
    rx = given_x if given_x is not None else given_y or 0.0
    ry = given_y if given_y is not None else rx
    rx, ry = min(rx, width / 2), min(ry, height / 2)
    return (rx, ry) if rx > 0 and ry > 0 else (0.0, 0.0)
