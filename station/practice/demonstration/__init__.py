"""The demonstration of a lesson: where in the song it is, and what sounds.

In: a score, the player's controls, time. Out: a place in the song, cues for the engine.
`song_player` is the player with its loop and steps, `song_cues` what the engine plays, `compare_by_ear` a bar to be
heard as the teacher and as the student played it.
Read `song_player` first.
"""
