"""Values into the text of SVG documents."""
