"""SVG in and out: the only package that imports svgpathtools or svgwrite."""
