"""Drum notation: engraved bars that scroll, pages, a highway, sheets to print.

In: a score and how it is to be shown. Out: flat shapes, anchored in time.
`staff` says where each piece stands and with which head, `bar_spelling` spells a voice of a bar and `rhythm` its beats,
`voice_pen` draws it, `engraving` sets a bar, `score_view` scrolls, `sheet` fills a page, `judgement_marks` are the
signs of right and wrong.
Read `engraving` first.
"""
