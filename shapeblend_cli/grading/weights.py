"""The weights of the features of a strip. `make judge-weights` fits them to grades by people."""

from __future__ import annotations

from shapeblend_cli.grading.features import Features

BASE = -0.205
"""Grade of a strip without faults."""

WEIGHTS = Features(
    edges_lost=0.593,
    edges_off=0.067,
    ink_lost=0.135,
    ink_off=0.009,
    swollen=0.552,
    thickness_off=0.563,
    patches=0.166,
    pieces=0.320,
    holes=0.293,
    detail=0.121,
    detour=0.975,
    pop=0.504,
    common_lost=0.000,
    outside=0.000,
    lopsided=0.076,
    grey=0.000,
)
"""Additions to the grade for the square root of each feature."""

GOOD = Features(
    edges_lost=0.083,
    edges_off=0.163,
    ink_lost=0.098,
    ink_off=0.130,
    swollen=0.065,
    thickness_off=0.181,
    patches=0.234,
    pieces=0.013,
    holes=0.010,
    detail=1.016,
    detour=0.495,
    pop=0.365,
    common_lost=0.133,
    outside=0.085,
    lopsided=0.091,
    grey=0.020,
)
"""Mean square roots of the features of strips that were graded as drawn by hand."""
