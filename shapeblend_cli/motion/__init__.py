"""Motions of matched shapes, the judge, and the choice between them."""
