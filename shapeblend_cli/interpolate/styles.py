"""Paint between two paints."""

from __future__ import annotations

from shapeblend_cli.model import Style


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
