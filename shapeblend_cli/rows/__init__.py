"""Blends as they are asked for outside the command line: rows of manifests, folders of drawings, projects.

It may import job, options, system, errors.
"""
