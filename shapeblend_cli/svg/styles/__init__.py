"""CSS in SVG: colours, declarations, style sheets, selectors."""
