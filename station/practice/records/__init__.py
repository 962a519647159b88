"""What a session leaves behind: folder, report, pairs, memory of a student.

In: a session's result. Out: files; and from them an earlier session, or the same judgements once more.
`report` says how it went, `memory` remembers a student and a lesson, `rejudge` judges a capture again.
Read `session_files` first.
"""
