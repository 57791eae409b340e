"""Solid plates with signs: cut out of them, or opening in them."""
