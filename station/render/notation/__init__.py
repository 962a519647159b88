"""Drum notation: engraved bars that scroll, pages, a highway, sheets to print.

In: a score and how it is to be shown. Out: flat shapes, anchored in time.
`spelling` says how time is written, `staff` where each piece stands and with which head, `voice` draws a voice,
`engraving` sets a bar, `screen` rolls it past the player, `page` fills paper.
Read `engraving` first.
"""
