"""Reading what the user names: a SCORE (lesson or music file), a PERFORMANCE (MIDI file or capture)."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from station.app.music_files.named_parts import existing, is_lesson, load_part
from station.app.music_files.read_captures import begins_as_capture, performance_of_capture
from station.cli.options.option_fields import unread
from station.core.errors import BadInput
from station.music.formats.smf.midi_part import MIDI
from station.music.performance import Performance
from station.music.score import Score

if TYPE_CHECKING:
    from station.motion.kit.kit import Kit
    from station.motion.sticking.hand_notes import Hands
    from station.practice.session.cues.quiet_bars import QuietBars
    from station.scenes.score_words import ScoreWords

MIDI_ENDINGS = MIDI.endings


def is_midi(name: str) -> bool:
    """Whether `name` ends as MIDI files do."""
    return Path(name).suffix.lower() in MIDI_ENDINGS


def load_score(name: str) -> Score:
    """The score that `name` means; of a lesson without its landing."""
    if not is_lesson(name):
        return load_part(name).score
    from station.app.music_files.find_own_lesson import find_any_lesson

    return find_any_lesson(name).score


def load_led_score(name: str, kit: Kit, hands: Hands | None = None, as_written: bool = False) -> Score:
    """The score that `name` means, a lesson with its landing.

    Its sticking is read for the `hands` that play `kit` unless `as_written`.
    """
    if not is_lesson(name):
        return load_score(name)
    from station.app.music_files.find_own_lesson import find_any_lesson
    from station.motion.sticking.limbs import as_led

    score = find_any_lesson(name).played_once
    return score if as_written else as_led(score, kit, hands)


def kit_of_lesson(name: str) -> str:
    """The drummer's kit that the lesson `name` asks for; empty where it asks for none or `name` is a music file."""
    if not is_lesson(name):
        return ""
    from station.app.music_files.find_own_lesson import find_any_lesson

    return find_any_lesson(name).kit


def words_of(name: str) -> ScoreWords:
    """What the score that `name` means says beside its notes."""
    from station.scenes.score_words import ScoreWords
    from station.scenes.take_spelling import take_spelling

    if not is_lesson(name):
        part = load_part(name)
        return ScoreWords(part.sections, part.beat_ticks, spelling=take_spelling(part))
    from station.app.music_files.find_own_lesson import find_any_lesson

    lesson = find_any_lesson(name)
    return ScoreWords(lesson.sections, lesson.beat_ticks, lesson.cues)


def load_score_and_performance(score_name: str, performance_name: str) -> tuple[Score, Performance]:
    """Both; of two MIDI files each helps to tell which maker's note numbers the other uses."""
    if not is_midi(performance_name):
        return load_score(score_name), _performance_of_capture(existing(performance_name))
    from station.music.formats.smf.standard_midi import guess_kit_map, performance_from_midi, read_midi, score_from_midi

    performance = read_midi(existing(performance_name))
    if not is_midi(score_name):
        return load_score(score_name), performance_from_midi(performance)
    score = read_midi(existing(score_name))
    score_map, performance_map = guess_kit_map(score, performance), guess_kit_map(performance, score)
    return score_from_midi(score, score_map), performance_from_midi(performance, performance_map)


def _performance_of_capture(path: Path) -> Performance:
    if not begins_as_capture(path):
        raise BadInput(path, "", f"neither a MIDI file ({', '.join(MIDI_ENDINGS)}) nor a capture")
    return performance_of_capture(path)


def bars_of_gap(text: str) -> QuietBars:
    """`2/1`: two bars with a click, one without; `random` …; raises `ArgumentTypeError` for anything else."""
    from station.practice.session.cues.quiet_bars import EXPECTED, gap_of

    try:
        return gap_of(text)
    except BadInput:
        raise unread(EXPECTED, text) from None
