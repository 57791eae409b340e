"""SVG files read and written: the only package that imports svgpathtools or svgwrite."""
