"""Points, curves, polygons and boxes, whatever they belong to."""
