"""What is right? Hits paired with notes, one to one at least total cost.

In: hits and notes in roughly the same time. Out: a `Matching`: match, miss, extra, wrong piece, ignored.
`pairing` solves the assignment exactly, `assignment` pairs a whole take, `live_judge` judges as hits come,
`hit_windows` has the windows, `match_classes` which pieces answer for each other, `ignored_hits` what nobody counts.
Read `assignment`, then `live_judge`.
"""
