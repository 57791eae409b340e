"""The studio: a page on this machine in which blends are corrected by hand."""
