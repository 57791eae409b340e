"""An SVG file into a `Drawing`."""
