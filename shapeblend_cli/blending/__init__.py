"""Two drawings become one blend: placed, paired, matched, moved and clipped."""
