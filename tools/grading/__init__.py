"""Strips that people graded, and the weights of features that are fitted to their grades."""
