"""Blends whose truth is known: limbs that turn about their joints, and morphs that motion designers authored."""
