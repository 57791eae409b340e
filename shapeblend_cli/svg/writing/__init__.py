"""SVG documents: frames, animations, figures."""
