"""From curves to polygons: flatten, place, normalise."""
