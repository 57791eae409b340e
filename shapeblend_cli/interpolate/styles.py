"""Paint between two paints."""

from __future__ import annotations

from typing import TYPE_CHECKING

from shapeblend_cli.model import Style

if TYPE_CHECKING:
    from collections.abc import Sequence


def blend_styles(a: Style, b: Style, t: float) -> Style:
    """Paint at time t.

    Colours blend channel by channel as they are written; paint that only one side has fades in or out in
    its own colour. What has nothing in between changes at half time.
    """
    fill, fill_opacity = _blend_paint(a.fill, a.fill_opacity, b.fill, b.fill_opacity, t)
    stroke, stroke_opacity = _blend_paint(a.stroke, a.stroke_opacity, b.stroke, b.stroke_opacity, t)
    width0 = a.stroke_width if a.stroke else b.stroke_width
    width1 = b.stroke_width if b.stroke else a.stroke_width
    return (a if t < 0.5 else b)._replace(
        fill=fill,
        fill_opacity=fill_opacity,
        stroke=stroke,
        stroke_opacity=stroke_opacity,
        stroke_width=(1.0 - t) * width0 + t * width1,
    )


def _blend_paint(
    colour0: str | None, opacity0: float, colour1: str | None, opacity1: float, t: float
) -> tuple[str | None, float]:
    if colour0 is None:
        return colour1, t * opacity1
    if colour1 is None:
        return colour0, (1.0 - t) * opacity0
    mixed = [
        round((1.0 - t) * c0 + t * c1)
        for c0, c1 in zip(bytes.fromhex(colour0[1:]), bytes.fromhex(colour1[1:]), strict=True)
    ]
    return "#" + bytes(mixed).hex(), (1.0 - t) * opacity0 + t * opacity1


def common_styles(styles: Sequence[Style]) -> list[Style]:
    """The same paints at every key: what a key lacks is there transparent, as the nearest key has it."""
    found = list(styles)
    filled = [k for k, style in enumerate(styles) if style.fill is not None]
    stroked = [k for k, style in enumerate(styles) if style.stroke is not None]
    for k in range(len(styles)):
        if filled and k not in filled:
            near = styles[min(filled, key=lambda other: abs(other - k))]
            found[k] = found[k]._replace(fill=near.fill, fill_opacity=0.0)
        if stroked and k not in stroked:
            near = styles[min(stroked, key=lambda other: abs(other - k))]
            found[k] = found[k]._replace(
                stroke=near.stroke, stroke_opacity=0.0, stroke_width=near.stroke_width
            )
    return found
