"""A free take: strokes by hand, clicks by arithmetic, and the capture of an engine that plays it all again."""

from pathlib import Path

import pytest

from station.core.events import Hit
from station.core.measured_latency import StoredCalibration
from station.core.pieces import Piece, Zone
from station.core.settings import Settings
from station.core.units import NS_PER_MS, NS_PER_S
from station.devices.capture.capture import read_capture
from station.devices.mapping.presets import GENERAL_MIDI_PRESET
from station.engine.engine import Engine
from station.engine.messages import Bus, Play, RecordCapture, Started
from station.music.performance import Performance
from station.practice.session.cues.click_pattern import PLAIN
from station.practice.session.device_latency import Latency, latency_of
from station.practice.session.free_play import LEAD_IN_NS, LONGEST_NS, FreeClick, FreePlay, listening_back, take_of

KIT = "kit"
LATE = latency_of(Settings(input_latency_ms=10.0, output_latency_ms=5.0), StoredCalibration())


def hit(at_ns: int, piece: Piece = Piece.SNARE) -> Hit:
    return Hit(at_ns, piece, Zone.HEAD, 90, device=KIT)


def test_an_hour_of_clicks_at_the_tempo_and_none_where_none_is_wished_for() -> None:
    cues = FreeClick(120.0, PLAIN).cues()
    assert len(cues) == 7200  # sixty minutes of 120
    assert cues["at_ns"][[0, 1, 4]].tolist() == [0, NS_PER_S // 2, 2 * NS_PER_S]
    assert len(FreeClick(120.0, None).cues()) == 0


def test_strokes_are_kept_in_the_time_that_the_student_heard() -> None:
    """At 2 s by the stamp, 10 ms of it the kit's and 5 the card's: 985 ms after the zero at 1 s."""
    play = FreePlay(FreeClick(100.0, None), LATE)
    play.handle(hit(NS_PER_S // 2))
    assert not play.hits, "before the first click there is no take"
    play.handle(Started(NS_PER_S))
    play.handle(hit(2 * NS_PER_S))
    assert [h.at_ns for h in play.hits] == [985 * NS_PER_MS]
    assert len(play.heard.recent) == 2, "both light the kit"
    play.advance(NS_PER_S + LONGEST_NS)
    assert not play.over
    play.advance(NS_PER_S + LONGEST_NS + 5 * NS_PER_MS)
    assert play.over


def test_what_is_kept_beside_the_capture() -> None:
    play = FreePlay(FreeClick(100.0, PLAIN))
    play.handle(Started(0))
    for at_s, piece in ((1, Piece.SNARE), (2, Piece.SNARE), (3, Piece.FLOOR_TOM_1)):
        play.handle(hit(at_s * NS_PER_S, piece))
    play.advance(4 * NS_PER_S)
    kept = play.document("Ada")
    assert (kept["student"], kept["tempo_bpm"], kept["click"], kept["length_s"]) == ("Ada", 100.0, True, 4.0)
    assert kept["strokes_of"] == {"snare": 2, "floor_tom_1": 1}


def test_the_capture_gives_the_take_again_and_it_sounds_at_its_times(tmp_path: Path) -> None:
    """Real engine, bytes of a General MIDI kit: kick 2.1 s, snare 2.6 s after the zero; a bar lasts two."""
    engine, play = Engine(), FreePlay(FreeClick(120.0, PLAIN))
    engine.use_preset(KIT, GENERAL_MIDI_PRESET)
    engine.device_found(KIT, 0)
    engine.advance(0)
    for command in (RecordCapture(tmp_path / "take"), *play.start()):
        engine.handle(command)
    for event in engine.advance(LEAD_IN_NS):
        play.handle(event)
    for at_ms, note in ((2100, 36), (2600, 38)):
        now_ns = LEAD_IN_NS + at_ms * NS_PER_MS
        for event in engine.advance(now_ns - 1):
            play.handle(event)
        engine.feed(KIT, bytes([0x99, note, 100]), now_ns)
    engine.handle(RecordCapture(None))
    for event in engine.advance(LEAD_IN_NS + 4 * NS_PER_S):
        play.handle(event)
    take = take_of(read_capture(tmp_path / "take"), Latency(), None)
    assert [(h.piece, h.at_ns) for h in take] == [(h.piece, h.at_ns) for h in play.hits]
    heard = listening_back(take, play.click)
    assert heard is not None
    assert heard.from_ns == 2 * NS_PER_S, "from the bar of the first stroke"
    struck = heard.cues[heard.cues["bus"] == Bus.DEMONSTRATION]
    assert struck["at_ns"].tolist() == pytest.approx([100 * NS_PER_MS, 600 * NS_PER_MS])
    clicks = heard.cues[heard.cues["bus"] == Bus.CLICK]
    assert clicks["at_ns"].tolist() == [k * NS_PER_S // 2 for k in range(5)], "until the last stroke has rung 1.5 s"


def test_one_hearing_begins_when_the_engine_says_and_ends_by_itself() -> None:
    take = Performance.from_hits([hit(3 * NS_PER_S)])
    heard = listening_back(take, FreeClick(60.0, None))
    assert heard is not None
    (play,) = heard.start()
    assert isinstance(play, Play)
    assert (heard.from_ns, heard.length_ns) == (0, 4_500_000_000)
    assert heard.at_ns(5) is None
    heard.handle(Started(NS_PER_S))
    assert heard.at_ns(3 * NS_PER_S) == 2 * NS_PER_S
    assert not heard.is_over(5 * NS_PER_S)
    assert heard.is_over(NS_PER_S + 4_500_000_000)
    assert listening_back(Performance.from_hits([]), FreeClick(60.0, None)) is None
