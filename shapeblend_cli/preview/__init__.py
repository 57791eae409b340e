"""The page of --preview.

It may import wires, frames, interpolate, paint, svg, options, model.
"""
