"""What hypothesis draws."""

import numpy as np
from hypothesis import strategies as st

from shapeblend_cli.geometry import cubics
from shapeblend_cli.model import Contour

seeds = st.integers(0, 10**9)
rngs = st.builds(np.random.default_rng, seeds)

coordinates = st.floats(-100.0, 100.0).map(lambda v: round(v, 3))
points = st.builds(complex, coordinates, coordinates)


@st.composite
def contours(draw, closed=None):
    """Chains of 1 to 6 cubics and lines, or 2 to 6: loops, cusps, handles of no length."""
    closed = draw(st.booleans()) if closed is None else closed
    count = draw(st.integers(1 + closed, 6))
    nodes = draw(st.lists(points, min_size=count + (not closed), max_size=count + (not closed), unique=True))
    kinds = draw(
        st.lists(st.sampled_from(["line", "curve", "curve", "retracted"]), min_size=count, max_size=count)
    )
    segments = []
    for k, kind in enumerate(kinds):
        start, end = nodes[k], nodes[(k + 1) % len(nodes)]
        inner = draw(st.tuples(points, points)) if kind == "curve" else (start, end)
        segments.append(cubics.line(start, end) if kind == "line" else [start, *inner, end])
    return Contour(np.array(segments), [kind == "line" for kind in kinds], closed)
