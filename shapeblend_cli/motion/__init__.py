"""Vertex paths that are not straight: how outlines go from one drawing to the next."""
