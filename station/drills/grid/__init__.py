"""The grid: one line of characters a piece, one character a cell, `|` between bars.

In: the table of a `[grid]`. Out: a `GridSection`, the strokes of each repetition; and the way back.
`grid` cuts lines into cells, `tab_symbols` says what each character plays, `cell_strokes` turns cells into strokes,
`line_group` puts lines and hands together, `cycles` and `loudness_line` run beside them, `grid_timing` holds what a
grid hands to the next, `grid_reader` reads the whole table, `grid_writer` and `lines_from_score` write one.
Read `grid`, then `tab_symbols`, then `grid_reader`.
"""
