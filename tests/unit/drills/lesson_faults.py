"""A lesson that uses every word of the format, and faults planted in it one at a time.

The expectations were written from docs/lesson-format.md, not from what the reader says. In the text of a fault `▶`
stands where the fault is to be named, line and column; `words` must be in the message: what is wrong, or the remedy.
"""

from dataclasses import dataclass

GOOD = '''\
title = "Everything at once"
author = "A teacher"
level = 3
tags = ["test", "form"]
about = """
A theme with two endings, a variation of it, seven eighths, and three against four that slows down.
"""
kit = ""
tempo_bpm = 80
meter = "4/4"
beat = "1/4"
swing_ratio = 1.5
swing_unit = "1/16"
loop = [1, 4]
passes = 4
count_in_bars = 1
demonstrations = 2
form = ["intro", "A", "A", "odd", "B", "out"]
prerequisites = ["rock-1", "single-paradiddle"]

[dynamics]
ghost = 30
normal = 80
accent = 115
kick = {normal = 90}

[graces]
flam_ms = 25
drag_ms = 50
share = 0.5

[landing]
crash = "X"
kick = "o"
sticking = "R"

[hints]
weak_left = "A minute with the left hand alone."

[goals]
level = "elementary"
strictest_level = "advanced"
min_accuracy = 0.9
max_sd_ms = 25
max_lean_ms = 20
max_swing_error = 0.5
max_loudness_error_db = 6
target_tempo_bpm = 90
min_score = 70
faults = {late_kick = 15, unsteady = "mute"}

[goals.left_hand]
min_accuracy = 0.8
max_sd_ms = 30

[[goals.bars]]
bars = [3, 4]
max_tempo_error_pct = 3
max_loudness_error_db = 5

[[grid]]
name = "intro"
snare = "o-o- o-o- o-o- oooo"
loudness = "p--- <--- ---- f---"

[[grid]]
name = "A"
times = 2
at = [
  {bar = 1, say = "Ghosts low"},
  {bar = 1, time = 2, camera = "hands", style = "natural"},
]
hihat = "x-x- x-x- x-x- x-x-"
snare = "---- O--g -v-- O---"
sticking = "R-R- B-RL RLR- B-R-"
kick = "o--- ---- o-o- ----"

[[grid]]
ending = 1
hihat = "x-x- x-x- x-x- x---"
kick = "o--- o--- o--- o---"

[[grid]]
ending = 2
snare = "(ooo) f--- d--- t---"

[[grid]]
name = "odd"
meter = ["3+2+2/8", "4/4"]
swing_ratio = 1
ride = "xxx (xxx) xx | x x x x"
left_foot.hihat_pedal = "--x-x-- | - x - x"

[[grid]]
name = "B"
meter = "4/4"
like = "A"
times = 1
at = []
snare = "---- O--u -v-- z---"
[grid.dynamics]
accent = 120
[grid.graces]
flam_ms = 20

[[grid]]
name = "out"
bars = 3
tempo_to_bpm = 60
at = [{bar = 3, beat = 2, tempo_bpm = 70, tempo_to_bpm = 50}]
kick = "o-o-|%2"
[[grid.cycle]]
meter = "3/4"
ride = "xxx|x-x"
'''


@dataclass(frozen=True, slots=True)
class Planted:
    """`old`, which stands once in `GOOD`, becomes `new`; `words` are in the one message."""

    old: str
    new: str
    words: str


FAULTS = (
    # the head
    Planted('title = "Everything at once"', 'title = ▶""', "one line"),
    Planted("level = 3", "level = ▶9", "from 1 to 5"),
    Planted('tags = ["test", "form"]', 'tags = ▶"test"', "a list of words"),
    Planted('about = """', '▶abuot = """', "did you mean about"),
    Planted('kit = ""', "kit = ▶3", "text in quotes"),
    Planted('kit = ""', 'kit = ▶"jaz"', "no such kit: jaz; did you mean jazz?"),
    Planted("tempo_bpm = 80", 'tempo_bpm = ▶"fast"', "a number from 10 to 1000"),
    Planted('meter = "4/4"\nbeat', 'meter = ▶"4"\nbeat', '"4/4"'),
    Planted('beat = "1/4"', 'beat = ▶"5/8"', '"3/8"'),
    Planted("swing_ratio = 1.5", "swing_ratio = ▶4", "from 1 to 3.5"),
    Planted("loop = [1, 4]", "loop = ▶[4, 1]", "first bar first"),
    Planted("loop = [1, 4]", "loop = [1, ▶16]", "from 1 to 15"),
    Planted("passes = 4", "passes = ▶0", "from 1 to 1000"),
    Planted("count_in_bars = 1", "count_in_bars = ▶9", "from 0 to 8"),
    Planted("demonstrations = 2", "demonstrations = ▶2.5", "whole number"),
    Planted('author = "A teacher"', 'author = "A teacher▶', "closing quote"),
    # form, prerequisites
    Planted('"odd", "B"', '"odd", ▶"b"', "B"),
    Planted('ride = "xxx|x-x"', 'ride = "xxx|x-x"\n[[grid]]\nname = ▶"coda"\nsnare = "o"', "expected coda in form"),
    Planted('form = ["intro", "A", "A", "odd", "B", "out"]', "form = ▶[]", '["A", "A", "B"]'),
    Planted('"rock-1", "single-paradiddle"', '"rock-1", ▶"rock-1"', "rock-1"),
    Planted('"rock-1", "single-paradiddle"', '"rock-1", ▶"rich"', "itself"),
    # dynamics, graces, landing, hints
    Planted("normal = 80\naccent", "normal = ▶128\naccent", "from 1 to 127"),
    Planted("kick = {normal = 90}", "kick = {normal = ▶20}", "rising"),
    Planted("flam_ms = 25", "flam_ms = ▶5", "from 10 to 80"),
    Planted("drag_ms = 50", "drag_ms = ▶200", "from 20 to 120"),
    Planted("share = 0.5", "share = ▶2", "from 0.1 to 1"),
    Planted("flam_ms = 25", "▶flam = 25", "did you mean flam_ms"),
    Planted('crash = "X"', 'crash = "▶XX"', "one letter"),
    Planted('crash = "X"', 'crash = "▶q"', "no letter for a crash"),
    Planted('crash = "X"', '▶crahs = "X"', "did you mean crash"),
    Planted("weak_left =", "▶weak_lefft =", "did you mean weak_left"),
    Planted('"A minute with the left hand alone."', "▶3", "text in quotes"),
    # goals
    Planted('level = "elementary"', 'level = ▶"studio"', "stricter than"),
    Planted("min_accuracy = 0.9", "min_accuracy = ▶90", "from 0 to 1"),
    Planted("max_loudness_error_db = 6", "max_loudness_error_db = ▶60", "from 0.5 to 40"),
    Planted("target_tempo_bpm = 90", "target_tempo_bpm = ▶70", "80"),
    Planted("unsteady =", "▶unstaedy =", "did you mean unsteady"),
    Planted("[goals.left_hand]", "▶[goals.third_hand]", "third_hand"),
    Planted("min_accuracy = 0.8", "min_accuracy = ▶8", "from 0 to 1"),
    Planted("max_sd_ms = 30", "▶max_tempo_error_pct = 3", "expected below [[goals.bars]]"),
    Planted("bars = [3, 4]", "bars = ▶[4, 3]", "first bar first"),
    Planted("bars = [3, 4]", "bars = [3, ▶40]", "from 1 to 15"),
    Planted("max_tempo_error_pct = 3", "max_tempo_error_pct = ▶80", "from 0.1 to 50"),
    Planted("[[goals.bars]]\nbars = [3, 4]", "▶[[goals.bars]]", "bars is missing"),
    # grids
    Planted("ending = 1\n", 'name = ▶"A"\nending = 1\n', "another name"),
    Planted('like = "A"', 'like = ▶"C"', "no such grid"),
    Planted('like = "A"', 'like = ▶"out"', "above"),
    Planted("times = 1\n", "times = ▶0\n", "from 1 to 100"),
    Planted("ending = 2", "ending = ▶1", "one at most"),
    Planted("ending = 2", "ending = ▶[2, 3]", "2 times"),
    Planted('[[grid]]\nname = "intro"', '[[grid]]\nending = ▶1\nsnare = "o"\n[[grid]]\nname = "intro"', "before"),
    Planted("tempo_to_bpm = 60", "tempo_to_bpm = ▶5", "from 10 to 1000"),
    Planted("bars = 3\n", "bars = ▶0\n", "from 1 to 2000"),
    Planted('bar = 1, say = "Ghosts low"', 'bar = ▶2, say = "Ghosts low"', "1 bar"),
    Planted('bar = 1, say = "Ghosts low"', 'bar = 1, beat = ▶2, say = "Ghosts low"', "tempo"),
    Planted('{bar = 1, say = "Ghosts low"}', "▶{bar = 1}", "say"),
    Planted("time = 2", "time = ▶3", "2 times"),
    Planted('camera = "hands"', 'camera = ▶"moon"', "hands"),
    Planted('style = "natural"', 'style = ▶"naturel"', "natural"),
    Planted("bar = 3, beat = 2", "bar = 3, beat = ▶5", "4 beats"),
    Planted('"3+2+2/8", "4/4"', '▶"3+2+2/7", "4/4"', "6/8"),
    # lines
    Planted("o-o- o-o- o-o- oooo", "o-o- o-o- o-o- ▶ooo", "15 cells do not fill a 4/4 bar"),
    Planted("x-x- x-x- x-x- x-x-", "x-x- x-x- x-▶q- x-x-", "no letter for a hihat"),
    Planted("o--- ---- o-o- ----", "▶v--- ---- o-o- ----", "no letter for a kick"),
    Planted("R-R- B-RL RLR- B-R-", "R-R- ▶Q-RL RLR- B-R-", "R, L, B"),
    Planted("xxx (xxx) xx", "▶x(xxx) xx xx", "group"),
    Planted("(ooo) f---", f"▶({'o' * 65}) f---", "1 to 64"),
    Planted('kick = "o-o-|%2"', 'kick = "▶%|o-o-|%"', "repeats the bar before it"),
    Planted("left_foot.hihat_pedal", "▶left_foot.hihat_peddal", "did you mean hihat_pedal"),
    Planted('left_foot.hihat_pedal = "', 'left_foot.snare = ▶"', "a foot plays no snare"),
    Planted("p--- <--- ---- f---", "p--- ▶<--- ---- ----", "mark"),
    Planted("p--- <--- ---- f---", "p--- ▶mmf- ---- f---", "ppp, pp, p"),
    Planted("p--- <--- ---- f---", "p--- <--- ▶>--- f---", "mark"),
    Planted("xxx|x-x", "xxx|x▶q-", "no letter for a ride"),
    Planted("xxx|x-x", "▶xx|x-x", "3/4"),
    Planted('meter = "3/4"\nride', 'meter = ▶"0/4"\nride', "1 to 32 beats"),
    Planted('ride = "xxx|x-x"', '▶rdie = "xxx|x-x"', "did you mean ride"),
    Planted('hihat = "x-x- x-x- x-x- x-x-"', '▶hiahat = "x-x- x-x- x-x- x-x-"', "did you mean hihat"),
    Planted('meter = "4/4"\nbeat = "1/4"', 'meter = ▶"4/5"\nbeat = "1/4"', "1/32"),
    # one slip of the finger is one fault
    Planted('name = "odd"', '▶nae = "odd"', "did you mean name"),
    Planted("ending = 1\n", "▶ening = 1\n", "did you mean ending"),
    Planted("bars = [3, 4]", "▶bas = [3, 4]", "did you mean bars"),
    Planted('{bar = 1, say = "Ghosts low"}', '{▶br = 1, say = "Ghosts low"}', "did you mean bar"),
    Planted('meter = "3/4"\nride', '▶meer = "3/4"\nride', "did you mean meter"),
    Planted('tags = ["test", "form"]\n', 'tags = ["test", "form"\n▶', "a list is not closed"),
    Planted("bars = 3\n", "bars = ▶4\n", "the lines have 3"),
    # what nobody can play
    Planted('kick = "o--- ---- o-o- ----"', 'tom_1 = "---- ▶o--- ---- ----"', "hands"),
)
