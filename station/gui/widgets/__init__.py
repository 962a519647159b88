"""Widgets that several panels share: icon buttons, rows that wrap, numbered slots, rulers and lanes.

In: values and sizes. Out: what was clicked or dragged. They know nothing of the practice.
Read `icon_button` first.
"""
