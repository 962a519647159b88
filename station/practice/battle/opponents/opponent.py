"""The drummers whom a student can battle: who they are, and the figures that make them sound like themselves.

Every figure is our choice unless a source is named; that they can be told apart by ear is measured
(docs/battle-drummer.md).
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

from station.core.did_you_mean import did_you_mean
from station.core.errors import BadInput
from station.practice.battle.ground import Feel, Ground
from station.practice.battle.opponents.idiom import ANYBODY, JAZZ, METAL, PLAIN, POCKET, ROCK, STEADY, Idiom


@dataclass(frozen=True, slots=True)
class Mistakes:
    """What an opponent gets wrong: `spread_ms` of timing beyond a human's own, `dropped` share of strokes left out.

    `lost_one` is how often, of the phrases, the last bar comes home late by up to a sixteenth.
    """

    spread_ms: float = 0.0
    dropped: float = 0.0
    lost_one: float = 0.0


@dataclass(frozen=True, slots=True)
class Manner:
    """How somebody improvises.

    `boldness` 0–1 is how far from the likely the notes go, 0.5 as drummers do; `takes_up` 0–1 how often a bar answers
    what was heard; `memory` 0–1.5 what the student's and its own last bars weigh against what drummers play in general,
    1 as predicts them best (`Wanted`). `density` scales the strokes a beat; `quotes` 0–1 is how often a bar of its own
    is one that its lessons taught it; `air` 0–1 is how often a bar's end is left to ring; `loudness` scales velocities
    and `contrast` their distance from the middle; `ornaments` is how much is dressed, 0.1 as drummers do; `fills`
    is how sure a phrase ends in a fill; `clock`
    scales a human's spread of timing and `lean_ms` is where it sits: before the click, as drummers do (HUMANS, Timing;
    −13 in the Groove MIDI Dataset). `lean_spread_ms` is how far its phrases lean apart, `evenness` 0–1 how alike
    they are in loudness.
    """

    boldness: float = 0.5
    takes_up: float = 0.4
    memory: float = 1.0
    density: float = 1.0
    quotes: float = 0.2
    air: float = 0.1
    loudness: float = 1.0
    contrast: float = 1.0
    ornaments: float = 0.1
    fills: float = 1.0
    clock: float = 1.0
    lean_ms: float = -13.0
    evenness: float = 0.5
    lean_spread_ms: float = 6.0


@dataclass(frozen=True, slots=True)
class Opponent:
    """One drummer.

    `name` is the word for commands, `title` and `about` what people read; `motion_style` a style of
    `motion/data/styles`, `figure` a shipped drummer; `ground` what it likes to play on. `vocabulary` are tags of the
    shipped lessons whose bars it knows; `styles` are those of the model (`beat_steps`) that are nearest to it, none
    where it plays what the ground says.
    """

    name: str
    title: str
    about: str
    motion_style: str
    figure: str
    ground: Ground
    manner: Manner
    idiom: Idiom
    vocabulary: tuple[str, ...]
    styles: tuple[str, ...]
    mistakes: Mistakes = field(default_factory=Mistakes)


_ALL = (
    Opponent(
        name="pocket",
        title="The pocket player",
        about="Plays little and means it: ghosts, a backbeat behind the beat, and a fill only where one belongs.",
        motion_style="funk",
        figure="curls",
        ground=Ground(96, style="funk"),
        manner=Manner(boldness=0.45, takes_up=0.35, density=0.95, contrast=1.15, ornaments=0.12, clock=0.8, lean_ms=2),
        idiom=POCKET,
        vocabulary=("funk", "soul", "hip-hop", "ghosts", "linear", "new-orleans"),
        styles=("funk",),
    ),
    Opponent(
        name="jazz",
        title="The jazz cat",
        about="Talks on the snare over a ride that swings, asks and answers, and leaves air.",
        motion_style="jazz",
        figure="beard",
        ground=Ground(132, feel=Feel.TRIPLET, style="jazz"),
        manner=Manner(
            boldness=0.6, takes_up=0.5, memory=0.8, density=0.85, air=0.25, loudness=0.82, ornaments=0.25, clock=1.0
        ),
        idiom=JAZZ,
        vocabulary=("jazz", "swing", "comping", "waltz"),
        styles=("jazz",),
    ),
    Opponent(
        name="metal",
        title="The metal machine",
        about="Both feet, all toms, every stroke loud and where it is written.",
        motion_style="wild",
        figure="headphones",
        ground=Ground(126, style="metal"),
        manner=Manner(
            boldness=0.45,
            takes_up=0.2,
            memory=1.0,
            density=1.35,
            quotes=0.8,
            air=0.02,
            loudness=1.18,
            contrast=0.4,
            clock=0.45,
        ),
        idiom=METAL,
        vocabulary=("metal", "double-kick", "blast", "punk"),
        styles=("punk",),
    ),
    Opponent(
        name="mirror",
        title="The mirror",
        about="Has nothing of its own: takes up what you play, turns it round and gives it back.",
        motion_style="smooth",
        figure="ponytail",
        ground=Ground(100, style="rock"),
        manner=Manner(boldness=0.5, takes_up=1.0, memory=1.5, quotes=0.0, air=0.05, ornaments=0.08),
        idiom=ROCK,
        vocabulary=("rock", "fill", "funk", "trading"),
        styles=(),
    ),
    Opponent(
        name="novice",
        title="The newcomer",
        about="Three months of lessons: keeps to two patterns, hurries, drops strokes and is good to win against.",
        motion_style="subdued",
        figure="any",
        ground=Ground(84, style="rock"),
        manner=Manner(
            boldness=0.25,
            takes_up=0.15,
            memory=0.8,
            density=0.7,
            quotes=0.6,
            air=0.12,
            loudness=0.95,
            contrast=0.5,
            clock=1.3,
        ),
        idiom=PLAIN,
        vocabulary=("rock", "eighths"),
        styles=("rock",),
        mistakes=Mistakes(spread_ms=24, dropped=0.07, lost_one=0.3),
    ),
    Opponent(
        name="steady",
        title="The steady one",
        about="Clear phrases, even loudness, always home on the one: the partner to practise with.",
        motion_style="natural",
        figure="any",
        ground=Ground(92, style="rock"),
        manner=Manner(
            boldness=0.35, takes_up=0.5, density=0.9, air=0.08, contrast=0.9, clock=0.6, lean_ms=-8, evenness=0.8
        ),
        idiom=STEADY,
        vocabulary=("rock", "fill", "soul", "country"),
        styles=("rock",),
    ),
)

OPPONENTS: Mapping[str, Opponent] = MappingProxyType({one.name: one for one in _ALL})
"""By name, in the order in which they are shown."""
USUAL_OPPONENT = "steady"
"""Whom a newcomer meets: most players prefer an even partner for practice (PEERS, Improvising machines: 40 % preferred
the improvising program for practice, 70 % on stage)."""


def find_opponent(name: str) -> Opponent:
    """The opponent of that name; raises `BadInput` that names the nearest."""
    if name not in OPPONENTS:
        raise BadInput("opponent", name, f"no such drummer{did_you_mean(name, OPPONENTS)}")
    return OPPONENTS[name]


ANY_DRUMMER = Opponent(
    name="any",
    title="Any drummer",
    about="Nobody in particular: what the model has learned, with a human's touch.",
    motion_style="natural",
    figure="any",
    ground=Ground(),
    manner=Manner(quotes=0.0, air=0.0, fills=0.3, evenness=0.0, lean_spread_ms=16.0),
    idiom=ANYBODY,
    vocabulary=(),
    styles=(),
)
"""Who is held against human drummers by measure; no student meets it."""
