"""Teacher and student without a server: assignments, returns and notes, each of them one file.

In: a stranger's file, or what a teacher or student did. Out: values, files, folders; or what is wrong, in one line.
`parcel` is the container that the three share, `student_store` and `teacher_store` keep what came and what was sent.
Read `parcel` first.
"""
