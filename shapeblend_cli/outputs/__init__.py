"""The formats of outputs, a module each."""
