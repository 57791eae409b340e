"""Corrections done in the studio as a designer does them, and how long it takes to answer: `make studio`."""
