"""The weights of the features of a strip. `make judge-weights` fits them to grades by people."""

from __future__ import annotations

from shapeblend_cli.grading.features import Features

BASE = -1.514
"""Grade of a strip without faults."""

WEIGHTS = Features(
    edges_lost=0.452,
    size_off=0.318,
    lumps=0.788,
    slivers=0.227,
    spikes=0.304,
    notches=0.433,
    directions=0.559,
    lopsided=0.632,
    patches=1.102,
    pieces=0.539,
    pop=0.344,
    detail=2.811,
)
"""Additions to the grade for each feature at its worst."""

GOOD = Features(
    edges_lost=0.273,
    size_off=0.167,
    lumps=0.016,
    slivers=0.295,
    spikes=0.023,
    notches=0.121,
    directions=0.554,
    lopsided=0.373,
    patches=0.005,
    pieces=0.003,
    pop=0.506,
    detail=0.424,
)
"""Mean shares of the features of strips that were graded as drawn by hand."""
