"""Mastery: what to practise next, and why, from how the last pass went."""
