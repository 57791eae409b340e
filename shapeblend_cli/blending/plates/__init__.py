"""Solid plates with signs: cut out of them, inverted with them, or opening in them."""
