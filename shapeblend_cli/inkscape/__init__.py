"""The extension for Inkscape: its files, and the functions behind them.

It may import pipeline, outputs, svg and what is below them.
"""
