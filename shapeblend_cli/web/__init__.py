"""JavaScript that plays blends in web pages.

It may import options.
"""
