"""Everything that knows SVG."""
