"""Which drawings make the best blend with one drawing."""
