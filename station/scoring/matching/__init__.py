"""Which hit answers which note, and which notes are right: one exact assignment of least total cost.

In: hits and notes in roughly the same time. Out: a `Matching`: match, miss, extra, wrong piece, ignored, played again.
`note_reach` says how far from its note a hit may lie, `pairing` solves the assignment, `attempts` and `ignored_hits`
what nobody counts, `right` what is right; `live_judge` gives the same verdicts hit by hit, `running_lean` its leans.
Read `take_matching`, `assignment`, then `live_judge`.
"""
