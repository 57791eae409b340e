"""The pen lines with which filled shapes may have been drawn."""
