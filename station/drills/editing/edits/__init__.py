"""How each family of edits is done: cells, signs, lines, bars, grids, keys, playing in, folding.

In: a `Draft` and an edit of `lesson_edits`. Out: another `Draft`, or `BadInput` in a sentence for a teacher. `upkeep`
and `timing_upkeep` keep what belongs to the strokes with them, `bar_numbers` what counts bars. First read `cell_edits`.
"""
