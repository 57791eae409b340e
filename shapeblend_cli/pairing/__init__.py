"""Which contour of A becomes which of B, and where those without a partner come from."""
