"""Pairs of icons whose blends were graded by eye, and what the judge of in-betweens says of these."""
