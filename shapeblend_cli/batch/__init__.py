"""Many blends: manifests and projects, records, processes and clusters, and rankings.

It may import job and what is below it.
"""
