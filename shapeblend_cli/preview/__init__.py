"""The page of --preview.

It may import wires, interpolate, paint, svg, options, model.
"""
