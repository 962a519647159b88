"""A loop of a bar at 120 bpm, two seconds, over a count-in of a bar; times by hand."""

from station.core.events import Hit
from station.core.measured_latency import StoredCalibration
from station.core.pieces import Piece, Zone
from station.core.settings import Settings
from station.core.units import NS_PER_MS, NS_PER_S, PPQ
from station.devices.mapping.presets import GENERAL_MIDI_PRESET
from station.engine.engine import Engine
from station.engine.messages import Bus, Play, Resume, Started
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from station.practice.session.device_latency import latency_of
from station.practice.session.loop_recording import LEAD_IN_NS, LONGEST_NS, LoopRecording

BAR_MS = 2000
LOOP = Score.from_notes([Note(0, Piece.KICK), Note(2 * PPQ, Piece.KICK)], TempoMap.constant(120.0))
LATE = latency_of(Settings(input_latency_ms=10.0, output_latency_ms=5.0), StoredCalibration())


def _recorded(*at_ms: int, recording: LoopRecording | None = None) -> LoopRecording:
    """A recording whose transport started at 0, with snare strokes so many ms after the first pass began."""
    found = recording or LoopRecording(LOOP)
    found.handle(Started(0))
    for each in at_ms:
        found.handle(Hit((BAR_MS + each) * NS_PER_MS, Piece.SNARE, Zone.HEAD, 90))
    return found


def _at(recording: LoopRecording, ms: int) -> LoopRecording:
    recording.advance((BAR_MS + ms) * NS_PER_MS)
    return recording


def test_the_click_counts_in_and_goes_on_over_every_pass() -> None:
    (play,) = LoopRecording(LOOP).start()
    assert isinstance(play, Play)
    assert len(play.cues) == 4 + 4 * 600  # a bar, then 600 bars of two seconds: twenty minutes
    assert play.cues["at_ns"][[0, 4, 8]].tolist() == [0, 2 * NS_PER_S, 4 * NS_PER_S]
    assert set(play.cues["bus"].tolist()) == {Bus.CLICK}


def test_the_guide_plays_what_stands_there_and_no_click_leaves_the_count_in() -> None:
    (play,) = LoopRecording(LOOP, click=None, guide=True).start()
    assert isinstance(play, Play)
    strokes = play.cues[play.cues["bus"] == Bus.DEMONSTRATION]
    assert (len(play.cues), len(strokes)) == (4 + 2 * 600, 2 * 600)
    assert strokes["at_ns"][:3].tolist() == [2 * NS_PER_S, 3 * NS_PER_S, 4 * NS_PER_S]


def test_each_pass_has_its_strokes_in_the_time_of_the_loop() -> None:
    recording = _at(_recorded(0, 500, 1500, 2010, 3990), 3990)
    (first,) = recording.finished()
    assert (first.index, first.is_whole) == (0, True)
    assert [hit.at_ns // NS_PER_MS for hit in first.hits] == [0, 500, 1500]
    assert recording.finished() == []
    (second,) = _at(recording, 4200).finished()
    assert [hit.at_ns // NS_PER_MS for hit in second.hits] == [10]  # 3990 is the next one's first beat
    (third,) = recording.rest()
    assert (third.index, third.is_whole) == (2, False)
    assert [hit.at_ns // NS_PER_MS for hit in third.hits] == [-10]
    assert recording.rest() == []


def test_a_stroke_that_is_early_for_a_pass_belongs_to_it_and_the_count_in_is_not_recorded() -> None:
    recording = _at(_recorded(-700, -59, 1939, 1941), 2500)
    first, second = recording.finished() + recording.rest()
    assert [hit.at_ns // NS_PER_MS for hit in first.hits] == [-59, 1939]
    assert [hit.at_ns // NS_PER_MS for hit in second.hits] == [-59]


def test_strokes_on_their_way_are_waited_for() -> None:
    recording = _at(_recorded(500), 2050)  # the pass is over, a stroke of it may still come
    assert recording.finished() == []
    recording.handle(Hit((BAR_MS + 1930) * NS_PER_MS, Piece.SNARE, Zone.HEAD, 90))
    (first,) = _at(recording, 2100).finished()
    assert [hit.at_ns // NS_PER_MS for hit in first.hits] == [500, 1930]


def test_latencies_are_taken_off() -> None:
    """The kit is 10 ms late, the sound card 5: a stroke stamped 515 ms after the beat was heard as 500."""
    recording = _at(_recorded(515, recording=LoopRecording(LOOP, latency=LATE)), 2500)
    (first,) = recording.finished()
    assert [hit.at_ns // NS_PER_MS for hit in first.hits] == [500]


def test_where_it_sounds_now() -> None:
    recording = LoopRecording(LOOP)
    assert (recording.at_ns, recording.at_tick, recording.pass_index) == (None, None, -1)
    _at(_recorded(recording=recording), -500)
    assert (recording.at_ns, recording.at_tick, recording.pass_index) == (-500 * NS_PER_MS, None, -1)
    _at(recording, 0)
    assert (recording.at_ns, recording.at_tick, recording.pass_index) == (0, 0, 0)
    _at(recording, 4500)
    assert (recording.at_ns, recording.at_tick, recording.pass_index) == (500 * NS_PER_MS, PPQ, 2)


def test_it_ends_after_the_longest_recording() -> None:
    recording = _recorded(10)
    assert not _at(recording, LONGEST_NS // NS_PER_MS).over
    assert _at(recording, LONGEST_NS // NS_PER_MS + 100).over
    recording.handle(Hit((BAR_MS + 5) * NS_PER_MS + LONGEST_NS, Piece.SNARE, Zone.HEAD, 90))
    assert [each.index for each in recording.finished() + recording.rest()] == [0]


def test_with_the_real_engine_and_the_bytes_of_a_kit() -> None:
    """A snare (note 38) on the second beat of the second pass: 2 s of count-in, 2 s of the first pass, 500 ms."""
    engine, recording = Engine(), LoopRecording(LOOP)
    engine.use_preset("kit", GENERAL_MIDI_PRESET)
    engine.device_found("kit", 0)
    engine.advance(0)
    for command in recording.start():
        engine.handle(command)
    for event in engine.advance(LEAD_IN_NS):
        recording.handle(event)
    now_ns = LEAD_IN_NS + 4500 * NS_PER_MS
    events = engine.advance(now_ns - 1)
    engine.feed("kit", bytes([0x99, 38, 100]), now_ns)
    for event in (*events, *engine.advance(now_ns + NS_PER_S)):
        recording.handle(event)
    recording.advance(now_ns + 2 * NS_PER_S)
    (only,) = recording.finished()
    assert only.index == 1
    assert [(hit.piece, hit.at_ns // NS_PER_MS) for hit in only.hits] == [(Piece.SNARE, 500)]


def test_what_was_written_meanwhile_sounds_from_there_on_at_the_transports_own_zero() -> None:
    fuller = Score.from_notes([Note(beat * PPQ, Piece.SNARE) for beat in range(4)], TempoMap.constant(120.0))
    recording = _at(_recorded(recording=LoopRecording(LOOP, click=None, guide=True)), 500)
    (resume,) = recording.with_loop(fuller)
    assert isinstance(resume, Resume)
    assert resume.zero_ns == 0
    strokes = resume.cues[resume.cues["bus"] == Bus.DEMONSTRATION]
    assert strokes["at_ns"][:3].tolist() == [2 * NS_PER_S, 2.5 * NS_PER_S, 3 * NS_PER_S]
    assert set(strokes["piece"].tolist()) == {Piece.SNARE}
    longer = Score.from_notes([Note(0, Piece.KICK)], TempoMap.constant(120.0), 8 * PPQ)
    assert recording.with_loop(longer) == ()
    assert _recorded(recording=LoopRecording(LOOP)).with_loop(fuller) == (), "nothing of it was heard before"
