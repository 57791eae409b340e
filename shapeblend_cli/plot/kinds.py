"""The names of plots, for the command line. Imports nothing."""

KINDS = ("graph", "surface", "angle", "starts")
"""Each is a module of that name beside this one."""

DOTTED = ("angle", "starts")
"""Those about a single dot."""
