"""The solver: the paper's graph, its work, and the path of least work."""
