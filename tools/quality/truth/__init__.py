"""Blends whose truth is known: letters of variable fonts, which their designers drew in between as well."""
