"""Whether a human can play what is written.

In: a score, alone (`playable`) or on a kit with its limbs chosen (`on_a_kit`). Out: what cannot be played, by note or
by bar, in words. Lessons ask the first, the drummer the second; `limb_speeds` has the speeds that both go by.
Read `playable` first.
"""
