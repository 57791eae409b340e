"""One run: what a blend is made of, from the files that are read to those that are written."""
