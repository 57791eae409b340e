"""Pictures of pixels in a file."""
