"""Options with their defaults, ranges and help, and the types that read and check them.

It may import errors, and svg.styles for colours and selectors.
"""
