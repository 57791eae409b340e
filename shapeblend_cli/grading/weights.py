"""The weights of the features of a strip. `make judge-weights` fits them to grades by people."""

from __future__ import annotations

from shapeblend_cli.grading.features import Features

BASE = -0.731
"""Grade of a strip without faults."""

WEIGHTS = Features(
    edges_lost=0.398,
    size_off=0.044,
    lumps=0.000,
    slivers=0.000,
    spikes=0.174,
    notches=0.000,
    directions=0.000,
    lopsided=0.000,
    patches=1.102,
    pieces=0.204,
    pop=0.217,
    detail=2.084,
)
"""Additions to the grade for each feature at its worst."""

TOGETHER = {
    ("lopsided", "detail"): 1.073,
    ("size_off", "lumps"): 0.786,
    ("size_off", "directions"): 0.712,
    ("spikes", "notches"): 0.509,
    ("spikes", "directions"): 0.496,
    ("notches", "lopsided"): 0.341,
    ("notches", "directions"): 0.321,
    ("spikes", "pieces"): 0.300,
    ("slivers", "directions"): 0.287,
    ("lumps", "spikes"): 0.276,
    ("lumps", "directions"): 0.253,
    ("directions", "pieces"): 0.238,
    ("size_off", "detail"): 0.129,
    ("slivers", "notches"): 0.108,
    ("lumps", "slivers"): 0.102,
    ("spikes", "lopsided"): 0.056,
    ("edges_lost", "detail"): 0.052,
}
"""Additions to the grade for two features that are at their worst at once."""

GOOD = Features(
    edges_lost=0.299,
    size_off=0.173,
    lumps=0.029,
    slivers=0.306,
    spikes=0.025,
    notches=0.131,
    directions=0.545,
    lopsided=0.374,
    patches=0.005,
    pieces=0.003,
    pop=0.516,
    detail=0.428,
)
"""Mean shares of the features of strips that were graded as drawn by hand."""
