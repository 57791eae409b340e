"""The page of --preview."""
