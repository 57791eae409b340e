"""How good a strip of frames looks, from 0, as drawn by hand, to 3, unusable: pictures, features, and their weights.

May import geometry and the model. Nothing here knows how a blend was made.
"""
