"""The formats: one module each, a registry, and their options.

It may import frames, svg.writing, options and what is below them.
"""
