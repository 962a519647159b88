"""Letters and flat shapes: the typeface, the atlas of glyphs, the list of what is drawn.

In: words, sizes, colours. Out: a table of shapes for the screen (`draw_list`) or polygons for paper (`paper`).
Read `draw_list` first.
"""
