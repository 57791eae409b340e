"""The version, which the package and the reports state."""

__version__ = "0.1.0"
