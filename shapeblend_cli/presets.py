"""The constants of the paper's table 1, by figure, and the diagonal deviation dd of the same row."""

from __future__ import annotations

PRESETS: dict[str, dict[str, float]] = {
    name: dict(zip(("ks", "kb", "es", "eb", "pb", "mb", "cs"), row, strict=True))
    for name, row in {
        "fig1": (1.0, 0.2, 2.0, 2.0, 1000.0, 10.0, 0.5),
        "fig2": (0.0, 1.0, 2.0, 2.0, 1000.0, 10.0, 0.5),
        "fig3": (1.0, 1.0, 2.0, 0.5, 1000.0, 10.0, 0.5),
        "fig8": (0.0, 1.0, 2.0, 0.8, 1000.0, 10.0, 0.5),
        "fig10": (1.0, 0.0, 2.0, 1.0, 1000.0, 10.0, 0.5),
        "fig11": (0.0, 1.0, 2.0, 1.0, 1000.0, 10.0, 0.5),
        "fig27": (0.3, 1.0, 2.0, 0.3, 1000.0, 10.0, 0.5),
        "fig28": (1.0, 0.1, 2.0, 0.1, 1000.0, 10.0, 0.5),
    }.items()
}

BANDS: dict[str, float] = {
    "fig1": 0.06,
    "fig2": 0.09,
    "fig3": 0.09,
    "fig8": 0.0,
    "fig10": 0.0,
    "fig11": 0.125,
    "fig27": 0.245,
    "fig28": 0.04,
}
