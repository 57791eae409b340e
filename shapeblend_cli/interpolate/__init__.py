"""Outlines between two drawings, or among several.

It may import geometry, paint, model.
"""
