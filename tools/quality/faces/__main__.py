"""Measure what becomes of eyes and mouths: python -m tools.quality.faces; with --wrong every pair that is not right."""

from tools.quality.faces import section
from tools.quality.labelled import main

main(section, section.ready, __doc__)
