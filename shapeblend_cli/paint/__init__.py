"""Paint between two paints: colours in OKLab, gradients, dashes."""
