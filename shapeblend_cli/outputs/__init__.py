"""The formats: one module each, a registry, and their options.

It may import web, frames, svg.writing, options and what is below them.
"""
