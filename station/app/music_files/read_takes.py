"""A take (a capture, and what is kept beside it) as a score: what the student played, for the drummer to play again."""

from pathlib import Path

from station.app.music_files.find_own_lesson import find_any_lesson
from station.app.music_files.read_captures import performance_of_capture
from station.core.errors import BadInput
from station.core.measured_latency import load_calibration
from station.core.settings import load_settings
from station.devices.capture.capture import read_capture
from station.devices.capture.replay import transport_zeros_ns
from station.music.as_played import score_as_played
from station.music.performance import Performance
from station.music.score import Score
from station.music.tempo import MAX_BPM, MIN_BPM, TempoMap
from station.practice.history.kept_json import kept_document
from station.practice.history.session_files import DOCUMENT_NAME, TAKE_NAME
from station.practice.session.device_latency import latency_of
from station.practice.session.free_play import take_of

FREE_TITLE = "Just play"
_NO_TEMPO_BPM = 120.0
"""Where nothing says a tempo bars are of two seconds."""


def take_as_score(path: Path) -> Score:
    """The strokes of the capture at `path`, from the bar of the first; raises `BadInput`.

    Title, tempo and meter are those of the free take or the session that is kept beside it, 120 bpm in 4/4 otherwise.
    """
    capture = read_capture(path)
    played = take_of(capture, latency_of(load_settings(), load_calibration()), None)
    if not transport_zeros_ns(capture):  # recorded without a transport: it begins with the first stroke
        played = performance_of_capture(path)
    if not len(played):
        raise BadInput(path, "", "there is no stroke in this capture")
    title, tempo_map = _of_document(path.resolve())
    return score_as_played(_from_first_bar(played, tempo_map), tempo_map, title)


def _from_first_bar(played: Performance, tempo_map: TempoMap) -> Performance:
    bar_ns = int(tempo_map.ns_at(tempo_map.bar_start(1)))
    return played.shifted(-(int(played.hits["at_ns"][0]) // bar_ns * bar_ns))


def _of_document(path: Path) -> tuple[str, TempoMap]:
    """What the documents beside a capture say of it; one that cannot be read says nothing."""
    session = _document(path.with_name(DOCUMENT_NAME)).get("session")
    if isinstance(session, dict):
        return str(session.get("title", path.stem)), _tempo_map(session, str(session.get("lesson", "")))
    take = _document(path.with_name(TAKE_NAME))
    return FREE_TITLE if take else path.stem, _tempo_map(take, "")


def _document(path: Path) -> dict[str, object]:
    try:
        said = kept_document(path)
    except BadInput:
        return {}
    return said if isinstance(said, dict) else {}


def _tempo_map(said: dict[str, object], lesson: str) -> TempoMap:
    tempo_bpm = said.get("tempo_bpm")
    if not isinstance(tempo_bpm, int | float) or not MIN_BPM <= tempo_bpm <= MAX_BPM:
        return TempoMap.constant(_NO_TEMPO_BPM)
    try:
        meter = find_any_lesson(lesson).score.tempo_map.meters[0]
    except BadInput:
        return TempoMap.constant(tempo_bpm)
    return TempoMap.constant(tempo_bpm, meter.beats, meter.unit)
