"""One drawing takes the place of another one if they would not blend well: when, and how."""
