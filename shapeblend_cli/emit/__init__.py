"""Blends for other programs to play, and what each of these takes."""
