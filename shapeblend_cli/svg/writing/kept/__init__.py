"""Text that stayed text, as elements."""
