"""Lessons, loops, rudiments and courses: what is practised."""
