"""What `station assignment` does, for students and for teachers.

In: options. Out: what was done, as text or as one JSON document; files where they were asked for.
`student_verbs` takes and returns, `teacher_verbs` gives, receives and answers.
Read `student_verbs` first.
"""
