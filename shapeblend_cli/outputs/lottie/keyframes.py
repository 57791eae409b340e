"""Properties of a Lottie: values at times, and the forms that numbers and paths have."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from shapeblend_cli.svg.writing.rounding import number

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from shapeblend_cli.model import CubicPath, Style
    from shapeblend_cli.options.easing import Ease
    from shapeblend_cli.outputs.move import MovedShape

TIME_DIGITS = 3
"""Decimals of times, in frames. Waypoints may lie between two frames."""


class Keyframes(NamedTuple):
    """The keyframes of a move: the frames of its start and its end, and its easing."""

    start: int
    end: int
    ease: Ease
    decimals: int

    def value(self, shape: MovedShape, of: Callable[[Style], Any]) -> dict[str, Any]:
        """Return a property of numbers or lists of numbers that a shape has by its style."""
        return self.property([(t, of(style)) for t, style in shape.styles])

    def opacity(self, shape: MovedShape, paint: str) -> dict[str, Any]:
        """Return the property of the opacity of a paint."""
        styles = [(0.0, shape.start.style), *shape.fading, (1.0, shape.end.style)]
        return self.property([(t, percent(getattr(style, f"{paint}_opacity"))) for t, style in styles])

    def path(self, shape: MovedShape, contour: int) -> dict[str, Any]:
        """Return the property of one of the paths of a shape."""
        inner = [(waypoint.t, waypoint.paths) for waypoint in shape.waypoints]
        stops = [(0.0, shape.start.paths), *inner, (1.0, shape.end.paths)]
        return self.path_over_time([(t, paths[contour]) for t, paths in stops])

    def path_over_time(self, stops: Sequence[tuple[float, CubicPath]]) -> dict[str, Any]:
        """Return the property of a path that has these forms at times."""
        return self.property([(t, bezier(path, self.decimals)) for t, path in stops])

    def trim(self, shape: MovedShape, side: int) -> dict[str, Any]:
        """Return the property of an end of the part of a path that is seen."""
        return self.property([(t, percent(part[side])) for t, part in shape.trims])

    def property(self, stops: Sequence[tuple[float, Any]]) -> dict[str, Any]:
        """Return the property with values at times."""
        from shapeblend_cli.outputs.move import sections

        end = stops[-1][1]
        if all(value == end for _, value in stops):
            return {"a": 0, "k": end}
        keys: list[dict[str, Any]] = []
        for section in sections(stops, self.end - self.start, self.ease, TIME_DIGITS):
            x1, y1, x2, y2 = (_speed(rounded(value, 4), end) for value in section.ease)
            time = rounded(self.start + section.times[0], TIME_DIGITS)
            keys.append(
                {"t": time, "s": _listed(section.start), "o": {"x": x1, "y": y1}, "i": {"x": x2, "y": y2}}
            )
        return {"a": 1, "k": [*keys, {"t": self.end, "s": _listed(end)}]}


def _listed(value: Any) -> list[Any]:
    return value if isinstance(value, list) else [value]


def _speed(number: float, value: Any) -> Any:
    """Return a number of easing in the form that a value takes: of paths it is no list."""
    return number if isinstance(value, dict) else [number]


def constant(values: dict[str, Any]) -> dict[str, Any]:
    """Return properties that do not change."""
    return {name: {"a": 0, "k": value} for name, value in values.items()}


def bezier(path: CubicPath, decimals: int) -> dict[str, Any]:
    """Return vertices with the tangents before and after them; a closed path has its first vertex once."""
    segments = path.segments.tolist()
    lines = path.straight.tolist()
    vertices = [p0 for p0, *_ in segments]
    leaving = [0j if line else p1 - p0 for (p0, p1, _, _), line in zip(segments, lines, strict=True)]
    arriving = [0j if line else p2 - p3 for (_, _, p2, p3), line in zip(segments, lines, strict=True)]
    if path.closed:
        arriving = [arriving[-1], *arriving[:-1]]
    else:
        vertices, leaving, arriving = [*vertices, segments[-1][3]], [*leaving, 0j], [0j, *arriving]
    lists = {"v": vertices, "i": arriving, "o": leaving}
    return {
        "c": path.closed,
        **{
            name: [[rounded(z.real, decimals), rounded(z.imag, decimals)] for z in points]
            for name, points in lists.items()
        },
    }


def percent(share: float) -> float:
    """Return a share as a percentage."""
    return rounded(100 * share, 2)


def rounded(value: float, decimals: int) -> float:
    """Return a rounded number, an int if it is whole, which JSON writes in its shortest form."""
    rounded = float(number(value, decimals))
    return int(rounded) if rounded.is_integer() else rounded
