"""Parts without a partner: when they come and go, and which of them fade.

It may import what `blending` may import, and `blending` itself.
"""
