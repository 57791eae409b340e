"""An SVG file as a tree: elements, numbers with units, transforms, and messages about them."""
