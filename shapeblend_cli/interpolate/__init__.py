"""In-betweens from a correspondence: when, where and in which paint."""
