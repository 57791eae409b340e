"""The least-work correspondence of two polygons."""
