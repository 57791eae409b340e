"""CSS in SVG: colours, declarations, style sheets, selectors.

It may import svg.xml.
"""
