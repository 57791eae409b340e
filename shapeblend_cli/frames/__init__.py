"""Frames of a blend: their times, shapes and views; fades and stagger."""
