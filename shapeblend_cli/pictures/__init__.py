"""SVG documents of ours to pictures of pixels: contact sheets, animations, and frames."""
