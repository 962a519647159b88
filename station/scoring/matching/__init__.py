"""What is right? Hits paired with notes, one to one at least total cost.

In: hits and notes in roughly the same time. Out: a `Matching`: match, miss, extra, wrong piece, ignored, played again.
`reach` says how far from its note a hit may lie, `pairing` solves the assignment exactly, `take_matching` matches whole
takes, `live_judge` judges as hits come, `attempts` and `ignored_hits` say what nobody counts, `right` what is right.
Read `take_matching`, `assignment`, then `live_judge`.
"""
