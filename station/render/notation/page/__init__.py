"""A score on paper: pages of lines of bars.

In: a `Score` and the words beside it. Out: `Ink` for each page. `sheet_bars` folds what comes again, `bar_columns`
measures the room that a bar wants, `line_breaks` chooses the lines, `sheet_line` sets one, `sheet_key` explains the
signs. Read `sheet` first.
"""
