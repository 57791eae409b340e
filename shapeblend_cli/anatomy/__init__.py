"""The parts of a drawing: contours and their roles, nesting, structure, twins."""
