"""From an SVG file to the shapes that it paints.

It may import svg.styles, svg.xml, geometry, model, errors.
"""
