"""Inkscape's extension: its files, and what it runs.

It may import pipeline, outputs, svg and what is below them.
"""
