"""The lesson that a teacher starts from."""

NEW_LESSON = '''\
# A lesson of the drum station. Lines that start with # are notes to yourself.
title = "My groove"
author = ""
level = 1                # 1 first steps … 5 expert
tags = ["rock", "groove"]
about = """
What to listen for, in a sentence or two.
"""

tempo_bpm = 80
meter = "4/4"
swing_ratio = 1.0        # 2.0 swings eighths as triplets
loop = [1, 2]            # first and last bar that are practised
passes = 8               # how often
count_in_bars = 1
demonstrations = 2       # the drummer plays it first

[goals]
level = "beginner"       # how strictly at first: beginner, elementary, intermediate, advanced, studio
target_tempo_bpm = 100

# One character is one cell: 8 a bar are eighths, 12 triplets, 16 sixteenths. - rests, | ends a bar, % repeats it.
# Drums: o stroke, O accent, g ghost, f flam, d drag, t diddle, b buzz, r rim shot, x cross-stick.
# Cymbals: x stroke, X accent, # choke. Hi-hat: x closed, h half open, o open. hihat_pedal: x chick, o splash.
[grid]
#             1& 2& 3& 4&   1& 2& 3& 4&
hihat    = "| xx xx xx xx | xx xx xx xx |"
snare    = "| -- O- -- O- | -- O- -- O- |"
sticking = "| RR BR RR BR | RR BR RR BR |"
kick     = "| o- -- o- -- | o- -o o- -- |"
'''
"""The text that a new lesson starts from; it is a lesson already."""
