"""Options with their defaults, ranges and help, and the types that read and check them."""
