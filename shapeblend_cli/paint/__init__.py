"""Styles, colours, gradients and names between two drawings."""
