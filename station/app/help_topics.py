"""What F1 says about the page that is open: what is to be seen there, what to do, what comes next."""

from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum
from types import MappingProxyType

from station.app.room_state import RoomState, Stage


class Topic(Enum):
    """What a user may be looking at."""

    LESSONS = "Lessons"
    JUST_PLAY = "Just play"
    PLAYING = "Playing"
    QUESTION = "The question before the result"
    RESULT = "The result"
    EDITOR = "The editor"
    EXAM = "An exam"
    BATTLE = "A battle"


@dataclass(frozen=True, slots=True)
class Help:
    """A short `head`, then what is where: (its name, what it says or does)."""

    head: str
    parts: tuple[tuple[str, str], ...]


HELP: Mapping[Topic, Help] = MappingProxyType(
    {
        Topic.LESSONS: Help(
            "Choose what to practise; the drummer and the score show it at once. Start counts in, demonstrates, and"
            " then it is your turn.",
            (
                ("The list", "from first steps to hard; the search finds words of title, level, author and tags"),
                ("+", "a new lesson, or Import…: music of any kind becomes one of your own, dropped on the window too"),
                ("Your name", "whose progress it is; press it and another student plays, by mouse or by a pad"),
                ("All lessons", "or one course, in its teacher's order; marks beside the lessons say how far you are"),
                ("the tempo follows me", "each pass begins where the last one led, and says why"),
                ("passes", "how often the loop is played"),
                ("click", "without it you are counted in, and the score then follows your own tempo"),
                ("Start", "or Enter, or two kicks; Esc stops, and what was played is kept and judged"),
                ("The strip", "plays the demonstration: step by step, backwards, at 10 to 200 %, counted in or not; its"
                 " keys are under Keys"),
                ("The ruler", "a drag over bars repeats them, and Start practises them; a double click takes all"),
            ),
        ),
        Topic.JUST_PLAY: Help(
            "Play what you like. Every stroke is recorded and shown on the kit and on the strip; nothing is judged.",
            (
                ("Tempo, click", "drag, type or tap a tempo, or play without a click"),
                ("Listen back", "plays the take once more; it is kept in your sessions folder"),
                ("Video of it", "films the drummer who plays your take"),
                ("Lesson of it", "puts your take on the grid, as a lesson of your own; Export has it as MIDI"),
            ),
        ),
        Topic.PLAYING: Help(
            "Listen, look at the drummer, and play along. Marks on the notes say what was heard.",
            (
                ("Ring", "on time, as your level says; its tick is where your stroke fell"),
                ("Arrow to the left", "early; to the right: late"),
                ("Barred ring", "missed; a square: the right time on a wrong pad; a cross: not written"),
                ("Wedge", "above the note: far too loud; below: far too soft"),
                ("Fewer marks", "they fade as passes get clean, and every fifth pass shows none"),
                ("As it was", "while a changed tempo is counted in: the last one once more"),
                ("Pause", "or Backspace, both crashes at once, a foot switch; by itself when you stop for two bars"),
                ("Panels, Practice", "what else shall pause, learnt from the kit; whether the score waits"),
                ("Go on", "or two kicks: a bar of count-in, then from the bar of your last stroke"),
                ("Stop", "or Esc: the session ends here and is kept"),
            ),
        ),
        Topic.QUESTION: Help(
            "Say first what you believe: rushed, dragged or on. Whoever guesses before looking learns to hear it.",
            (
                ("Answer", "a pad, after a second of silence: hi-hat rushed, snare on, ride or floor tom dragged"),
                ("1 to 3", "or the mouse: the same"),
                ("Not now", "or Esc: the result without an answer"),
                ("Panels, Practice", "has a tick for it: no question any more"),
            ),
        ),
        Topic.RESULT: Help(
            "One number, what it is made of, and what to do next.",
            (
                ("Every stroke", "signed milliseconds over the bars: above the line late, below it early"),
                ("Piece by piece", "the dot is where you lean, the band how far you spread; a lean is a habit or a"
                 " latency, a spread is practice"),
                ("What to do next", "the one thing that helps most, where the numbers are sure of it"),
                ("Bar by bar", "a click on a bar practises it alone"),
                ("Wrong pads", "what was struck for what; a click shows the bar where it happened most"),
                ("Hear and see a bar", "as the teacher plays it, as you did, and as you did yesterday: the translucent"
                 " sticks are yours"),
                ("Panels, Every hit", "each stroke over the bars; the mouse asks, a click chooses its bar"),
                ("The buttons below", "what comes next: Enter or two kicks take the first, 1 to 4 or its pad any"),
                ("Esc", "back to the lessons"),
            ),
        ),
        Topic.EXAM: Help(
            "One take, marked by the rubric beside it: nothing is demonstrated, and nothing is said until it is over.",
            (
                ("The time", "runs down while you look; try on the kit what you like"),
                ("I am ready", "or Enter: a count-in, then the piece once, from beginning to end"),
                ("Leave", "or Esc: nothing is played, but the piece counts as one that you have met"),
                ("The notes", "stay as they were looked at; a prepared lesson has its score under the picture"),
                ("Stop", "ends the take: it is marked over the whole piece"),
                ("The marks", "stand beside what was asked; the result behind them is that of any session"),
            ),
        ),
        Topic.BATTLE: Help(
            "You against a drummer or a friend, bar after bar; nothing stops the music between rounds.",
            (
                ("Repeat", "the drummer plays a phrase, you play it back at once; what is right of it wins the round"),
                ("Improvise", "you trade bars; each turn is judged by six things, and says what it saw"),
                ("The drummers", "each has a manner; choose one by what is said of them"),
                ("Pads", "below the page: the snare begins, the others turn what stands on them, More has the rest"),
                ("Who", "also a friend on the network, at another station: one hosts, the other joins"),
                ("The board", "who is on, how much of the turn is left, what the last turns were worth and why"),
                ("Pause", "or Backspace; two kicks begin a battle, but never end or pause one"),
                ("Stop", "or Esc: it ends here and is kept"),
                ("The result", "press a round to see what it was made of; the windows may be others, the strokes stay"),
                ("See the best bar", "once more, on the stage, at half its tempo; Keep a video has the whole battle"),
                ("Practise it", "the phrase that went worst becomes a lesson of your own"),
            ),
        ),
        Topic.EDITOR: Help(
            "Write a lesson: the drummer plays what stands there while you write. Every change is kept as a draft.",
            (
                ("The grid", "a click writes a stroke or takes it away, a drag paints; right click: all letters"),
                ("The bars' numbers", "a click goes there, a drag selects bars and repeats them, a double click none"),
                ("A line's name", "a click goes into the line; a right click takes it away"),
                ("Keys", "letters write at the cursor and go on; all keys are on the other leaf"),
                ("Record, Kit", "play it in over the click, or let each stroke write at the cursor"),
                ("How fine", "what a click and the arrows go by; bars are cut finer where they must be"),
                ("Text", "the lesson as it is kept; what you change there is in the grid at once"),
                ("Save", "or Ctrl+S: among your own lessons; a lesson that ships is saved as a copy"),
                ("A line in orange", "what is wrong in the text, and where; the drummer plays the last good music"),
            ),
        ),
    }
)  # fmt: skip


def topic_of(room: RoomState, free: bool, edits: bool = False) -> Topic:
    """What the page is about; `free` where Just play is chosen or runs, `edits` where a lesson is written."""
    if room.battle:
        return Topic.BATTLE
    if room.exam:
        return Topic.EXAM
    if room.stage is Stage.RESULT:
        return Topic.QUESTION if room.question else Topic.RESULT
    if edits:
        return Topic.EDITOR
    if free:
        return Topic.JUST_PLAY
    return Topic.PLAYING if room.stage is Stage.PLAYING else Topic.LESSONS
