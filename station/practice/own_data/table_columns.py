"""The tables that a student takes away: their columns, and what each holds, as README.txt tells it."""

from collections.abc import Mapping
from types import MappingProxyType

from station.practice.history.kept_rows import FIGURE_FIELDS, SESSION_FIELDS
from station.store.rows import JudgementRow

SESSIONS, FIGURES, JUDGEMENTS, LEVELS = "sessions.csv", "figures.csv", "judgements.csv", "levels.csv"

COLUMNS: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        SESSIONS: SESSION_FIELDS,
        FIGURES: ("session", *FIGURE_FIELDS),
        JUDGEMENTS: ("session", "line", *JudgementRow._fields),
        LEVELS: ("lesson", "level"),
    }
)
"""What the columns of each table are called, in order."""

ABOUT: Mapping[str, str] = MappingProxyType(
    {
        SESSIONS: "a row a session, the oldest first",
        FIGURES: "how each limb and each drum or cymbal did in a session",
        JUDGEMENTS: "every written note and every stroke of every session",
        LEVELS: "how strictly each lesson is judged",
    }
)

_SHARED: Mapping[str, str] = MappingProxyType(
    {
        "session": "the session's number in sessions.csv",
        "notes": "how many notes were judged",
        "strokes": "how many strokes mean_ms and sd_ms rest on",
        "mean_ms": "milliseconds: how far off the strokes were on average; negative is early, positive late",
        "sd_ms": "milliseconds: how far they spread about that mean (standard deviation)",
        "level": "how strictly was judged",
        "lesson": "the lesson's name; empty where none was played",
    }
)
_OF_TABLE: Mapping[str, Mapping[str, str]] = MappingProxyType(
    {
        SESSIONS: {
            "number": "the session's number, by which the station's commands know it",
            "student": "the student's name",
            "name": "what the session's folder is called",
            "started": "when it began, by the clock on the wall: YYYY-MM-DDThh:mm:ss",
            "folder": "where its files lay on the computer",
            "kind": "lesson, take (just played) or battle",
            "state": "kept, or begun where it was cut off before it was judged",
            "title": "the lesson's title",
            "device": "what was played on",
            "played_s": "seconds of music that were played",
            "complete": "true where it was played to its end",
            "score": "0 to 100; empty where nothing was judged",
            "beats_a_minute": "the tempo, in the beat of the lesson",
            "right": "how many of the notes were right",
            "first_bar": "the first bar that was practised, from 1; this and what follows is empty if unknown",
            "last_bar": "the last bar of the lesson that was practised",
            "click": "true where a click was heard",
            "gap": "where the click fell silent: sounding bars / silent bars",
            "input_latency_ms": "milliseconds that the kit is late by, taken out",
            "output_latency_ms": "milliseconds that the speakers are late by, taken out",
            "top_beats_a_minute": "the fastest tempo, where the tempo rose",
            "exam": "what it came to as an exam, in words",
            "capture_sha256": "the name of its file in captures/: the SHA-256 of what was played",
        },
        FIGURES: {
            "part": "limb or piece",
            "name": "which limb or piece",
            "matched": "how many of the notes were struck",
            "misses": "how many were not",
            "wrong_piece": "how many were struck on another drum or cymbal",
        },
        JUDGEMENTS: {
            "line": "its place among the session's, from 0",
            "label": "match, miss, wrong_piece, extra, ignored, played_again or unknown",
            "pass_number": "which time through, from 1",
            "bar": "the bar, from 1",
            "beat": "the beat in the bar, from 1",
            "note_index": "which note of the score, from 0; this and what follows is empty where there was no note",
            "note_time_s": "seconds: when it was to be struck",
            "note_midi": "its number in General MIDI",
            "hit_index": "which stroke, from 0; this and what follows is empty where nothing was struck",
            "hit_time_s": "seconds: when it was struck",
            "hit_midi": "its number in General MIDI",
            "hit_piece": "the drum or cymbal",
            "hit_zone": "where on it",
            "hit_articulation": "how it was struck",
            "hit_velocity": "how hard, 1 to 127",
            "hit_openness": "of a hi-hat: 0 closed to 1 open; empty where the kit cannot tell",
        },
        LEVELS: {},
    }
)


def meaning(table: str, column: str) -> str:
    """What a column holds, and its unit."""
    return _OF_TABLE[table].get(column) or _SHARED[column]
