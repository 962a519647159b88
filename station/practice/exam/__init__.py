"""One take of an exam piece: how it is laid out and run, its marks as a document and as text, and where they are kept.

In: an `ExamPiece` (`drills.exam`), the session's result. Out: a plan without demonstration and feedback, `exam.json`.
First read `exam_take`.
"""
