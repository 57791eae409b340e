"""The formats: one module each, a registry, and their options."""
