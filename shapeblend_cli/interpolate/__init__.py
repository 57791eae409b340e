"""In-betweens from a correspondence: when and where."""
