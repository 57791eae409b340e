"""Outlines between two drawings, or among several."""
