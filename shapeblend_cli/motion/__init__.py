"""How matched shapes move: the motions, the judge, and the choice between them.

It may import interpolate, geometry, model.
"""
