"""Plots of a correspondence in the style of the paper's figures."""
