"""Pictures of pixels in a file.

It may import svg.styles, geometry, images, svg.xml, errors, model.
"""
