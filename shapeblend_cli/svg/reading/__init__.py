"""From an SVG file to the shapes that it paints."""
