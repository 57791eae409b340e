"""What users can ask for: every option with its default, range and help, and how it is read and checked.

It may import errors, and svg.styles for colours and selectors.
"""
