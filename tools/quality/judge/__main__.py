"""Measure how the judge agrees with grades by eye: python -m tools.quality.judge.

With --wrong it prints every pair of which `auto` does not take the best.
"""

from tools.quality.judge import pairs, section
from tools.quality.labelled import main

main(section, pairs.ready, __doc__)
