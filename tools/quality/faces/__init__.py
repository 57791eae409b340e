"""Faces whose eyes and mouths are known, and what becomes of them."""
