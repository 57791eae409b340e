"""Strokes beside outlines: expanded to outlines, drawn on and back, of several drawings, and of brushes."""
