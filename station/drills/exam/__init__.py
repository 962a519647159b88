"""An exam: what is to be played, by which rubric it is marked, and the marks of one take.

In: a lesson or a seed, and the aligned take. Out: an `ExamPiece`, and `Marks` of a `Rubric` that is shown before.
Pure. First read `rubric`, then `exam_piece`.
"""
