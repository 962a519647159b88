"""What a student owns: all of their folder taken into the history, taken away as plain files, or deleted.

In: a history, settings, a student's name. Out: what came in; a folder or an archive of CSV and JSON; counts of what is
gone and words for what is left. Read `catching_up`, `take_away` and `student_deletion`.
"""
