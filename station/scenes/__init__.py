"""From the practice to pictures: what a session, a demonstration or a result looks like as a `Snapshot`.

In: sessions, drummers, results. Out: snapshots, curves, tables of a result, films and pictures without a window.
`session_scene` fills a session's snapshots, `student_figure` moves the student's double, `comparison` shows both,
`hit_table`, `heat_map` and `wrong_pads` are tables of a result, `film` and `pictures` need no window.
Read `session_scene` first.
"""
