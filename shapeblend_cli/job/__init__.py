"""One run: what a blend is made of, from the files that are read to those that are written.

It may import everything but cli, batch, studio, plot and inkscape.
"""
