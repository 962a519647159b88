"""What a student owns: everything of theirs as plain files to take away, and everything of theirs deleted.

In: a history, settings, a student's name. Out: a folder or an archive of CSV and JSON; counts of what is gone and words
for what is left. Read `take_away` and `student_deletion`.
"""
