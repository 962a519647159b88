"""Drum tablature as people type it: a line a piece, a character a cell, `|` between bars.

In: bytes of a text. Out: a `DrumPart`, and back. `tab_letters` says what labels and characters mean, `tab_text` finds
systems, bars and words in a text, `tab_reader` and `tab_writer` are the two ways.
Source: the letters of the drum tablature article of Wikipedia, and labels as tab archives list them.
"""
