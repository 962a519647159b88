"""Songs as sound files: where their attacks are.

In: the path of a song. Out: `SoundOnsets`.
`song_onsets` listens: `onset_strength` moment by moment, `attack_times` to a millisecond.
First read `song_onsets`.
"""
