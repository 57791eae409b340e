"""Layers of pictures in a Lottie, and masks of layers."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

from shapeblend_cli.outputs.lottie.keyframes import Keyframes, bezier, constant, percent, rounded

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from shapeblend_cli.model import CubicPath, Raster
    from shapeblend_cli.outputs.move import MovedPicture, MovedShape

FRAME_RATE = 60

PIXEL_DIGITS = 4
"""Decimals of the places, sizes and angles of pictures: of pixels, percents and degrees."""


def masks_of(
    shape: MovedShape, path: Callable[[Sequence[tuple[float, CubicPath]]], dict[str, Any]]
) -> dict[str, Any]:
    """Return the regions of a layer outside of which it is not seen, if it has some."""
    if not shape.clips:
        return {}
    masks = [
        {"inv": False, "mode": "i" if k else "a", "nm": f"clip-{k + 1}", "pt": path(stops)}
        | constant({"o": 100, "x": 0})
        for k, stops in enumerate(shape.clips)
    ]
    return {"hasMask": True, "masksProperties": masks}


class Assets:
    """The pictures of an animation, each once, and compositions of pictures that are clipped, in `found`."""

    def __init__(self, size: tuple[int, int], scale: float, centre: complex) -> None:
        self.found: list[dict[str, Any]] = []
        self._size = dict(zip("wh", size, strict=True))
        self._scale, self._shift = scale, complex(*size) / 2.0 - scale * centre
        self._names: dict[Raster, str] = {}

    def layers(self, shape: MovedShape, keys: Keyframes, times: dict[str, int]) -> list[dict[str, Any]]:
        """Return layers for the coats of a picture, the lowest first; one, of a composition, if it is clipped."""
        layers = [self._layer(shape.name, each, keys, times) for each in shape.pictures]
        if not shape.clips:
            return layers
        # In a layer of pixels masks move with them, and not by themselves.
        name = f"clipped-{sum('layers' in asset for asset in self.found) + 1}"
        inner = [{"ind": ind, **layer} for ind, layer in enumerate(reversed(layers), 1)]
        self.found.append({"id": name, "nm": name, "fr": FRAME_RATE, "layers": inner})
        masks = masks_of(shape, lambda stops: keys.property([(t, self._placed(path)) for t, path in stops]))
        still = {"ks": constant({"o": 100, "r": 0, "p": [0, 0, 0], "a": [0, 0, 0], "s": [100, 100, 100]})}
        named = {"ddd": 0, "ty": 0, "nm": shape.name, "refId": name, **self._size, "sr": 1}
        return [{**named, **still, **masks, "ao": 0, **times, "bm": 0}]

    def _placed(self, path: CubicPath) -> dict[str, Any]:
        return bezier(replace(path, segments=self._scale * path.segments + self._shift), PIXEL_DIGITS)

    def _layer(
        self, name: str, moved: MovedPicture, keys: Keyframes, times: dict[str, int]
    ) -> dict[str, Any]:
        """Return a layer of a picture by its own place, which its transform has in full."""
        raster = moved.picture.raster
        poses = [(t, pose, pose.centre * self._scale + self._shift) for t, pose in moved.poses]

        def changing(of: Callable[[Any, complex], Any]) -> dict[str, Any]:
            return keys.property([(t, of(pose, centre)) for t, pose, centre in poses])

        def percents(pose: Any, _: complex) -> list[float]:
            sides = pose.width / raster.width, pose.height / raster.height
            return [*(rounded(100.0 * self._scale * side, PIXEL_DIGITS) for side in sides), 100]

        placed = {
            "o": keys.property([(t, percent(opacity)) for t, opacity in moved.opacities]),
            "r": changing(lambda pose, _: rounded(pose.angle, PIXEL_DIGITS)),
            "p": changing(lambda _, at: [rounded(z, PIXEL_DIGITS) for z in (at.real, at.imag)] + [0]),
            "s": changing(percents),
            "sk": changing(lambda pose, _: rounded(-pose.skew, PIXEL_DIGITS)),
            **constant({"a": [raster.width / 2, raster.height / 2, 0], "sa": 0}),
        }
        named = {"ddd": 0, "ty": 2, "nm": name, "refId": self._name(raster), "sr": 1}
        return {**named, "ks": placed, "ao": 0, **times, "bm": 0}

    def _name(self, raster: Raster) -> str:
        """Return the name of a picture, which is there as PNG or JPEG: not all players know WebP."""
        if raster not in self._names:
            from shapeblend_cli.images.decode import as_png

            name = self._names[raster] = f"picture-{len(self._names) + 1}"
            written = as_png(raster, max(raster.width, raster.height)) if "webp" in raster.kind else raster
            size = {"w": raster.width, "h": raster.height}
            self.found.append({"id": name, **size, "u": "", "p": written.uri, "e": 1})
        return self._names[raster]
