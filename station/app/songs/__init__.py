"""Songs: a part and a band's sound brought together, from the command line and in the window.

In: the names of a part and of sound files, points that a listener sets. Out: a song file whose every beat has its time.
`song_sync` does the work, in a process of its own where a window waits. First read `song_sync`.
"""
