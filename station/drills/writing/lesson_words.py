"""What each key of a lesson says, in one sentence: shown by editors, and the reference page is made of it.

A key is named by the way to it without indices, `goals.bars.max_sd_ms`; the longest end of that way that stands here
counts, so that `max_sd_ms` need not be said again for every limb.
"""

from collections.abc import Mapping
from types import MappingProxyType

LINES = "<line>"
"""Stands for the key of any piece's line, `snare` or `hihat`."""

WORDS: Mapping[str, str] = MappingProxyType(
    {
        # the lesson
        "title": "the lesson's name, in one line",
        "author": "who wrote it",
        "level": "how hard it is: 1 first steps, 2 beginner, 3 intermediate, 4 advanced, 5 expert",
        "tags": "words that say what it is about",
        "about": "what the student should know, in a few sentences",
        "prerequisites": "lessons, by their names, that should be mastered before this one",
        "kit": "the drummer's kit, by its name, or a kit file that ends in .toml; left out, the player's own",
        "tempo_bpm": "beats a minute (80 if nothing says it)",
        "grid.tempo_bpm": "beats a minute from this grid on",
        "tempo_to_bpm": "the tempo changes evenly over this grid, all its repetitions together, and would reach this at"
        " its end; the next grid of the file goes on from `tempo_bpm`",
        "meter": 'such as "6/8" ("4/4" if nothing says it); numbers before the slash group the beats, "3+2+2/8"; a list'
        " is taken in turn, bar by bar",
        "beat": 'what `tempo_bpm` counts and `(…)` fills in a meter without groups: "1/4" if nothing says it, in 6/8'
        ' and 12/8 usually "3/8"',
        "swing_ratio": "long to short; 1, if nothing says it, is straight, 2 the triplet feel",
        "swing_unit": 'the cells that swing, "1/8" or "1/16" ("1/8" if nothing says it)',
        "loop": "first and last bar that are practised, as played, counted from 1; left out, all",
        "passes": "how often the loop is played",
        "count_in_bars": "bars of click before it",
        "demonstrations": "how often the drummer plays it first",
        "form": 'the order in which the grids are played, by their names: a list, or "intro, A, A, B"; "A x3" is'
        ' A three times, "(A, B) x2" both twice; left out, each once, as written',
        "landing": "what is struck on the first beat after the last loop: lines of one letter each",
        "hints": "what the report adds where it names a fault: the fault's word and a sentence",
        # how strokes are struck
        "dynamics": "velocities of soft, normal and accented strokes; in a table of a piece's name, of that piece",
        "ghost": "velocity of a ghost stroke (32 if nothing says it)",
        "normal": "velocity of a normal stroke (80 if nothing says it)",
        "accent": "velocity of an accent (116 if nothing says it)",
        "graces": "the grace strokes of flams and drags",
        "flam_ms": "how long before its note a flam's grace stroke sounds (30 if nothing says it)",
        "drag_ms": "how far apart the strokes of a drag are (55 if nothing says it)",
        "share": "the grace strokes' share of their note's velocity (0.4 if nothing says it)",
        f"dynamics.{LINES}": "velocities of this piece alone",
        # goals
        "goals": "when the lesson is mastered",
        "goals.level": "how strictly a student is judged who begins; left out, what suits the lesson's level",
        "strictest_level": "how strictly anybody is judged",
        "min_accuracy": "share of the notes right",
        "max_sd_ms": "spread of the strokes about the player's own feel",
        "max_lean_ms": "how far the mean may lie early or late; left out, feel is free",
        "max_loudness_error_db": "mean distance from the written loudness",
        "max_tempo_error_pct": "how far the tempo played may lie from the click's",
        "max_swing_error": "how far the swing may lie from `swing_ratio`",
        "target_tempo_bpm": "the tempo to reach, in the lesson's beats, `tempo_bpm` or more",
        "min_score": "points of a pass, of 100",
        "faults": 'from which size a fault counts, or "mute" where it is never named',
        "goals.right_hand": "what is asked of the right hand besides",
        "goals.left_hand": "what is asked of the left hand besides",
        "goals.right_foot": "what is asked of the right foot besides",
        "goals.left_foot": "what is asked of the left foot besides",
        "goals.bars": "what is asked of some bars besides, one table for each run of bars",
        "goals.bars.bars": "first and last bar, as played, counted from 1",
        # grids
        "grid": "the music: one table, or several that are played one after the other",
        "grid.name": "what the form and the report call it",
        "like": "a grid written above: this one says and plays what that one does, but for what stands here; a line of"
        " the same name takes the place of its line",
        "times": "how often it is played, one after the other",
        "ending": "this grid is an ending of the grid before it, played after that grid's repetitions of these numbers;"
        " that grid is played as often as its endings say where it has no `times`",
        "grid.bars": "how many bars it has; needed only where all its lines are cycles",
        "at": "what happens at bars: tables, one a line",
        "cycle": "lines of another meter that begin with the grid and run on over its bars and repetitions",
        "cycle.meter": "the meter of these lines",
        "sticking": "the hand under each stroke: R, L, B for both at once, - to leave it open",
        "loudness": "marks from ppp to fff in the cells where they begin, < and > from one mark to the next",
        LINES: "what is played on this piece: a letter a cell",
        "timing": "how late each stroke of a line is played, in ms, as somebody played it; left out, on its cell",
        f"timing.{LINES}": "milliseconds, from -60 (early) to 60, one for each stroke of the line in all its bars, also"
        " those written %",
        "timing.right_hand": "timing of the lines that stand in the table of the right hand",
        "timing.left_hand": "timing of the lines that stand in the table of the left hand",
        "timing.right_foot": "timing of the lines that stand in the table of the right foot",
        "timing.left_foot": "timing of the lines that stand in the table of the left foot",
        "right_hand": "lines that the right hand plays",
        "left_hand": "lines that the left hand plays",
        "right_foot": "lines that the right foot plays",
        "left_foot": "lines that the left foot plays",
        # at
        "at.bar": "the bar of this grid, from 1",
        "at.beat": "the beat of the meter, from 1; only with a tempo",
        "at.time": "the repetition that it holds in; left out, all",
        "say": "words of the teacher, shown from that bar on",
        "camera": "the view from that bar on",
        "style": "the drummer's style from that bar on",
        "at.tempo_bpm": "the tempo from there on",
        "at.tempo_to_bpm": "from there the tempo changes evenly up to the end of that repetition, or the next tempo",
    }
)


def words_of(path: tuple[str, ...]) -> str:
    """What the key at `path` says, names of pieces being `LINES`; empty where nothing is known of it."""
    ends = (".".join(path[start:]) for start in range(len(path)))
    return next((WORDS[end] for end in ends if end in WORDS), "")
