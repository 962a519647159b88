"""Drum notation: engraved bars that scroll, pages, a highway, sheets to print.

In: a score and how it is to be shown. Out: flat shapes, anchored in time.
`spelling` says how time is written, `staff` where each piece stands and with which head, `voice_pen` draws a voice,
`engraving` sets a bar, `score_view` scrolls, `page` fills paper, `judgement_marks` are the signs of right and wrong.
Read `engraving` first.
"""
