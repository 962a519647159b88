"""Notation while somebody plays: what the window and films show of a score and of the strokes that are judged.

In: an engraved score, or a score's lanes, and the time. Out: flat shapes. `score_view` rolls or turns pages, `highway`
has a lane for each piece, `free_strip` shows what nobody judges, `judgement_marks` are the signs of right and wrong.
Read `score_view` first.
"""
