"""Lottie: the animation with its layers and paint, keyframes, and layers of pictures.

It is a part of `outputs`, and may import what that may.
"""
