"""Pictures of a tracked phase: its plot with E_max, a skeleton that walks, and both on one page.

In: times, phases and positions as arrays. Out: tables of flat shapes. Read `phase_plot` first.
"""
