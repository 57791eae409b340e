"""What Inkscape needs to blend what is selected: an extension, and the command that it calls."""
