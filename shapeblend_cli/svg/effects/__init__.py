"""Effects on shapes and groups as SVG declares them: filters, opacity and blend modes.

It may look into `svg.styles`, `svg.xml`, `geometry`, `images` and `model`.
"""
