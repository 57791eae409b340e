"""Text that may stay text."""
