"""A page that shows a blend in a browser: the moving picture, the correspondence, and its graph."""
