"""The version, which the package and the reports state."""

__version__ = "1.0.0"
