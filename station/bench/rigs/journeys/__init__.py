"""Takes of people who begin anywhere, skip, repeat and stop, for what follows a player to be measured on.

In: a kind and a seed. Out: a score, hits on it, and what of the truth an ear can know.
`journey_music` is what they play from, `journey_ways` their ways through it, `journey_takes` what is heard.
Read `journeys` first.
"""
