"""The drummer who listens and answers: what was played beat by beat, and what may come next.

In: turns that were heard, a ground, what is wanted, a seeded generator. Out: beats, and phrases made of them.
`played_beats` reads a turn onto its beats; `beat_model` says how likely beats are, by a trained network and the
player's own bars, and `continuation.continued` goes on from them, as `wanted` says. Read `played_beats` first.
"""
