"""A page that shows a blend in a browser: the picture moving, the correspondence, and the graph it was found in."""
