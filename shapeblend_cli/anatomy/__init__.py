"""What a drawing is made of: contours and their roles, nesting, structure, twins.

It may import geometry, model, errors.
"""
