"""Music in files and links that the user names, drops on the window or plays: in as lessons, out in any format.

In: paths, links, captures, lessons. Out: drum parts, lesson files, music files, and what was lost, in sentences.
`named_parts` says what a name means, `lesson_import` makes lessons, `part_export` writes. The command line and the
window both come here.
Read `named_parts`, then `lesson_import`.
"""
