"""Pen lines: drawings as the lines that they were drawn with, each with a width, caps and joins."""
