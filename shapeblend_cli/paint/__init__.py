"""Styles, colours, gradients and names between two drawings.

It may import model.
"""
