"""One drawing takes the place of another one with which it has too little in common: when, and how.

It may import what `blending` may import, and `blending` itself.
"""
