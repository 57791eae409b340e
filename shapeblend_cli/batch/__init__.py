"""Many blends: their plan, records and cache, the processes and clusters that make them, and rankings.

It may import rows, job and what is below that.
"""
