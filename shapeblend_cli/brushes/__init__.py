"""Brush strokes: drawings such as handwriting as centre lines, each with an outline beside it."""
