"""A song: a drum part with the sound file of a band that played it, without a click.

In: song files, the part's score, onsets of the sound, points that a listener has set. Out: a `Song`, a time for every
beat of the score in the file, and a `Lesson` that is practised like any other. Pure: no sound, no window.
First read `song`, then `song_file` and `song_lesson`; of the band's time `band_tempo`, then `band_following`.
"""
