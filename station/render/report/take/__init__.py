"""The take of a report, to see and to hear in a browser: the drummer who plays what the student played.

In: `shown_take.ShownTake`. Out: a fragment of HTML that carries model, sound and viewer, and asks nothing of a network.
Read `take_part` first; `viewer` holds the scripts, and a library of others with its licence.
"""
