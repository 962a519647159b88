"""A virtual band: songs whose every beat is known, played without a click, for tests and measurements.

In: a seed. Out: the drum part's score, the times at which the band plays its beats, and the sound, made by numpy alone.
`band_timing` is how bands drift, `band_part` what the drummer plays, `band_sound` how all of it sounds.
First read `made_song`.
"""
