"""Pairs of contours, contours without a partner, and the shapes that they make up."""
