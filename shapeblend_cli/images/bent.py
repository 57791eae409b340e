"""A bent picture, as pixels of a frame or as triangles of a document."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.images.decode import as_png, encoded, pixels_of
from shapeblend_cli.images.sampling import Layer, draw_triangles
from shapeblend_cli.model import Box, CubicPath, Picture

if TYPE_CHECKING:
    from shapeblend_cli.images.bending import Mesh
    from shapeblend_cli.model import ComplexArray, FloatArray, Raster, UIntArray

OVERLAP = 0.04
"""Share by which triangles in documents are larger than they are, about their middles."""


class BentPicture(NamedTuple):
    """A picture of A that becomes one of B within an outline, at a time."""

    pictures: tuple[Picture, Picture]  # where they are in both drawings
    weights: tuple[float, float]  # of both; together the opacity
    share: float  # of the way of the places in a picture that stays one
    mesh: Mesh

    @property
    def layers(self) -> list[tuple[Picture, ComplexArray, float]]:
        """What is seen: a picture, the places of the mesh's points within it, from 0 to 1 each way, and its weight."""
        mesh = self.mesh
        places = [
            _within(picture, points)
            for picture, points in zip(self.pictures, (mesh.in_a, mesh.in_b), strict=True)
        ]
        if self.pictures[0].raster == self.pictures[1].raster:
            one = (1.0 - self.share) * places[0] + self.share * places[1]
            return [(self.pictures[0], one, sum(self.weights))]
        every = zip(self.pictures, places, self.weights, strict=True)
        return [layer for layer in every if layer[2] > 0.0]

    @property
    def box(self) -> Box:
        """The box around it."""
        return Box.around(self.mesh.points)

    def pixels(self, corner: complex, scale: float, width: int, height: int) -> UIntArray:
        """Return its pixels, premultiplied.

        Parameters
        ----------
        corner : complex
            Where the first pixel begins.
        scale : float
            Pixels in a unit of length.
        width, height : int
            Size in pixels.

        Returns
        -------
        (height, width, 4) uint8
        """
        triangles = self.mesh.triangles
        layers = []
        for picture, places, weight in self.layers:
            seen = scale * min(abs(picture.across), abs(picture.down))
            pixels = _premultiplied(picture.raster, 1 << max(round(seen) - 1, 1).bit_length())
            sources = places.real * pixels.shape[1] + 1j * places.imag * pixels.shape[0]
            layers.append(Layer(_pairs(sources[triangles]), pixels, weight))
        corners = scale * (self.mesh.points - corner)
        return draw_triangles(_pairs(corners[triangles]), layers, width, height)

    def drawn(self, view: Box, side: int) -> Picture:
        """Return it as a picture of the whole view, of some pixels on the longer side."""
        from PIL import Image

        scale = side / view.larger_side
        width, height = max(1, round(scale * view.width)), max(1, round(scale * view.height))
        corner = complex(view.x, view.y)
        pixels = self.pixels(corner, scale, width, height)
        image = Image.frombuffer("RGBa", (width, height), pixels.tobytes(), "raw", "RGBa", 0, 1)
        raster = encoded(image.convert("RGBA"), self.pictures[0].raster)
        return Picture(raster, corner, complex(width / scale), 1j * height / scale)

    def triangles(self) -> list[tuple[float, list[tuple[Picture, CubicPath]]]]:
        """Return it as layers, each with its opacity: pictures, of which the inside of a triangle is seen."""
        corners = self.mesh.points[self.mesh.triangles]
        opacity, layers = 1.0, []
        for picture, places, weight in reversed(self.layers):
            # Of a layer below others only what these let through is seen.
            own = weight / opacity if opacity > 0.0 else 0.0
            found = [
                (_mapped(picture, source, corner), _triangle(corner))
                for source, corner in zip(places[self.mesh.triangles], corners, strict=True)
            ]
            layers.append((min(own, 1.0), found))
            opacity -= weight
        return layers[::-1]


def _mapped(picture: Picture, source: ComplexArray, corner: ComplexArray) -> Picture:
    """Return a picture at the place where three points in it, from 0 to 1 each way, come to three corners."""
    ones = np.stack([np.ones(3), source.real, source.imag], axis=1)
    origin, across, down = np.linalg.solve(ones.astype(complex), corner).tolist()
    return picture._replace(origin=origin, across=across, down=down)


def _triangle(corner: ComplexArray) -> CubicPath:
    """Return a triangle, a little larger, so that no gap is seen to the next one."""
    middle = corner.mean()
    size = np.abs(corner - middle).max()
    corner = middle + (corner - middle) * (1.0 + OVERLAP) if size > 0.0 else corner
    ends = np.roll(corner, -1)
    segments = corner[:, None] + (ends - corner)[:, None] * np.array([0.0, 1.0, 2.0, 3.0]) / 3.0
    return CubicPath(segments, np.ones(3, np.bool_), True)


def _within(picture: Picture, points: ComplexArray) -> ComplexArray:
    """Return places within a picture, from 0 to 1 across and down."""
    offsets = points - picture.origin
    area = (picture.across.conjugate() * picture.down).imag
    across = (offsets.conj() * picture.down).imag / area
    down = (picture.across.conjugate() * offsets).imag / area
    return across + 1j * down


def _pairs(points: ComplexArray) -> FloatArray:
    return np.stack([points.real, points.imag], axis=-1)


@lru_cache(maxsize=8)
def _premultiplied(raster: Raster, most: int) -> UIntArray:
    """Return the pixels of a picture, made smaller as `as_png` does."""
    return np.array(pixels_of(as_png(raster, most)).convert("RGBa"))
