"""The figure panel: how the demonstrator moves, which style, and the lanes over the bars.

Read `style_panel` first; it draws the head and the lanes.
"""
