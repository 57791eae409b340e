"""Plots of a correspondence in the style of the paper's figures.

It may import job and what is below it.
"""
