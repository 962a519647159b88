"""Widgets that several panels share: rows that wrap, numbered slots, plots, rulers and lanes.

In: values and sizes. Out: what was clicked or dragged. They know nothing of the practice.
Read `flow_row` first.
"""
