"""Joins that are smooth in both drawings, and stay so in between."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry import cubics

if TYPE_CHECKING:
    from shapeblend_cli.model import BoolArray, ComplexArray, FloatArray

def smooth(before: ComplexArray, after: ComplexArray, least: float) -> BoolArray:
    """Whether directions agree to within an angle; not where one is missing."""
    turn = after * before.conj()
    return turn.real > np.cos(least) * np.maximum(np.abs(turn), 0.5)


def eased(
    segments_a: ComplexArray,
    segments_b: ComplexArray,
    line_a: BoolArray,
    line_b: BoolArray,
    closed: bool,
    corner: float,
) -> tuple[ComplexArray, ComplexArray]:
    """Divide lines that become curves so that they leave as fast as their neighbours arrive."""
    both = []
    ok = np.ones(len(segments_a), np.bool_)
    for segments in (segments_a, segments_b):
        begin, end = cubics.directions(segments)
        ok &= smooth(end, np.roll(begin, -1), corner)
        both.append((np.abs(segments[:, 3] - segments[:, 2]), np.roll(np.abs(segments[:, 1] - segments[:, 0]), -1)))
    (in_a, out_a), (in_b, out_b) = both
    ok &= (np.minimum(in_a, out_a) > 0.0) & (np.minimum(in_b, out_b) > 0.0)
    if not closed:
        ok[-1] = False
    with np.errstate(divide="ignore", invalid="ignore"):
        rho = np.where(ok, np.log(in_a * out_b / (out_a * in_b)), 0.0)
    free_a, free_b = line_a & ~line_b, line_b & ~line_a
    free = free_a | free_b
    share = rho / np.maximum(1, free.astype(int) + np.roll(free, -1))
    factor_in = np.exp(np.clip(share, -1.4, 1.4))
    factor_out = np.roll(factor_in, 1)
    result = []
    for segments, these, sign in ((segments_a, free_a, -1.0), (segments_b, free_b, 1.0)):
        segments = segments.copy()
        chord = segments[:, 3] - segments[:, 0]
        head = np.clip(factor_out ** -sign / 3.0, 0.05, 0.9)
        tail = np.clip(factor_in ** sign / 3.0, 0.05, 0.9)
        segments[these, 1] = (segments[:, 0] + head * chord)[these]
        segments[these, 2] = (segments[:, 3] - tail * chord)[these]
        result.append(segments)
    return result[0], result[1]
