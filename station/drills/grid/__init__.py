"""The grid: one line of characters a piece, one character a cell, `|` between bars.

In: the text of a `[grid]` table. Out: strokes of a score; and the way back.
`tab_symbols` says what each character plays, `cell_strokes` turns cells into strokes, `grid_reader` reads a table,
`grid_writer` writes one.
Read `grid`, then `tab_symbols`.
"""
