"""The session as a state machine, driven by hand: one bar of four quarters on the snare at 120 bpm."""

from datetime import date

import pytest

from station.core.events import DeviceFound, DeviceLost, Hit, StickStroke
from station.core.measured_latency import DeviceLatency, MeasuredLatency, StoredCalibration
from station.core.pieces import Limb, Piece, Zone
from station.core.settings import Settings
from station.core.units import NS_PER_MS, NS_PER_S, PPQ
from station.drills.lesson import Lesson
from station.engine.engine import KEYBOARD
from station.engine.messages import Play, Sounding, Started
from station.music.judgement import Label
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from station.practice.session.device_latency import Latency, latency_of
from station.practice.session.plan import TAIL_NS, Phase, PlanOptions, plan_practice
from station.practice.session.session import Session

BAR_NS = 2 * NS_PER_S
BEAT_NS = NS_PER_S // 2
ZERO_NS = 50 * NS_PER_S


def session(latency: Latency | None = None, loops: int = 1) -> Session:
    score = Score.from_notes([Note(i * PPQ, Piece.SNARE) for i in range(4)], TempoMap.constant(120))
    lesson = Lesson(name="quarters", title="Quarters", score=score)
    made = Session(plan_practice(lesson, PlanOptions(demonstrations=0, loops=loops)), latency or Latency())
    _, play = made.start()
    assert isinstance(play, Play)
    made.handle(Started(ZERO_NS))
    return made


def snare(at_ns: int, piece: Piece = Piece.SNARE) -> Hit:
    return Hit(ZERO_NS + BAR_NS + at_ns, piece, Zone.HEAD, 80)


def test_hits_are_judged_as_they_come() -> None:
    practice = session()
    (early,) = practice.handle(snare(-7 * NS_PER_MS))
    assert (early.label, early.note_index, early.asynchrony_ns) == (Label.MATCH, 0, -7 * NS_PER_MS)
    (late,) = practice.handle(snare(BEAT_NS + 12 * NS_PER_MS))
    assert (late.note_index, late.asynchrony_ns) == (1, 12 * NS_PER_MS)


def test_a_note_that_nobody_plays_is_a_miss_in_time() -> None:
    practice = session()
    practice.handle(snare(0))
    verdicts = practice.advance(ZERO_NS + BAR_NS + 2 * BEAT_NS - 100 * NS_PER_MS)
    assert [(v.label, v.note_index) for v in verdicts] == [(Label.MISS, 1)]
    assert practice.verdicts[1].label is Label.MISS


def test_hits_of_count_in_are_not_judged() -> None:
    practice = session()
    assert practice.handle(snare(-BEAT_NS)) == ()
    assert len(practice.result().performance) == 0


def test_nothing_is_judged_before_the_transport_runs() -> None:
    score = Score.from_notes([Note(0, Piece.SNARE)], TempoMap.constant(120))
    practice = Session(plan_practice(Lesson(name="one", title="One", score=score), PlanOptions()))
    assert practice.handle(snare(0)) == ()
    assert practice.advance(ZERO_NS) == ()
    assert not practice.over


def test_latency_is_taken_out() -> None:
    """A kit 4 ms late and a sound 10 ms late: a hit stamped 14 ms after its written time was on it."""
    practice = session(Latency(input_ns=4 * NS_PER_MS, output_ns=10 * NS_PER_MS))
    (verdict,) = practice.handle(snare(14 * NS_PER_MS))
    assert verdict.asynchrony_ns == 0


def test_phases_and_end() -> None:
    practice = session()
    practice.advance(ZERO_NS + BAR_NS // 2)
    assert practice.state().segment.phase is Phase.COUNT_IN
    practice.advance(ZERO_NS + BAR_NS)
    assert practice.state().segment.phase is Phase.PASS
    practice.advance(ZERO_NS + 2 * BAR_NS + TAIL_NS - 1)
    assert not practice.over
    practice.advance(ZERO_NS + 2 * BAR_NS + TAIL_NS)
    assert practice.over


def test_an_early_downbeat_belongs_to_the_next_pass() -> None:
    practice = session(loops=2)
    for beat in range(4):
        practice.handle(snare(beat * BEAT_NS))
    (verdict,) = practice.handle(snare(BAR_NS - 30 * NS_PER_MS))
    assert (verdict.note_index, verdict.asynchrony_ns) == (4, -30 * NS_PER_MS)


def test_a_last_note_that_was_left_out_is_no_matter_of_the_next_pass() -> None:
    """The stroke on one of the next pass comes 40 ms early, 460 ms after the note that nobody played."""
    practice = session(loops=2)
    for beat in range(3):
        practice.handle(snare(beat * BEAT_NS))
    said = practice.handle(snare(BAR_NS - 40 * NS_PER_MS))
    assert [(v.label, v.note_index) for v in said if v.label is Label.MATCH] == [(Label.MATCH, 4)]
    practice.advance(ZERO_NS + 2 * BAR_NS + BEAT_NS)
    assert practice.verdicts[3].label is Label.MISS
    assert practice.verdicts[4].asynchrony_ns == -40 * NS_PER_MS


@pytest.mark.parametrize("first_ms", [-30, 0, 60])
def test_passes_are_judged_each_by_itself(first_ms: int) -> None:
    """However late or early the first pass, the second is on time."""
    practice = session(loops=2)
    for beat in range(8):
        late_ms = first_ms if beat < 4 else 0
        practice.handle(snare(beat * BEAT_NS + late_ms * NS_PER_MS))
    heard = [practice.verdicts[note].asynchrony_ns for note in range(8)]
    assert heard == [first_ms * NS_PER_MS] * 4 + [0] * 4


@pytest.mark.parametrize(("at_ms", "piece", "label"), [
    (-40, Piece.CRASH_1, Label.IGNORED),
    (90, Piece.KICK, Label.IGNORED),
    (10, Piece.SNARE, Label.IGNORED),
    (10, Piece.TOM_1, Label.EXTRA),
    (400, Piece.CRASH_1, Label.EXTRA),
])  # fmt: skip
def test_a_fill_includes_its_landing_on_one(at_ms: int, piece: Piece, label: Label) -> None:
    """Inside the loop the next pass's one is the landing; behind the last pass it is nobody's extra."""
    practice = session()
    for beat in range(4):
        practice.handle(snare(beat * BEAT_NS))
    (said,) = practice.handle(snare(BAR_NS + at_ms * NS_PER_MS, piece))
    assert said.label is label
    practice.advance(ZERO_NS + 2 * BAR_NS + TAIL_NS)
    alignment = practice.result().alignment
    assert (alignment.count(label), alignment.count(Label.MATCH)) == (1, 4)


@pytest.mark.parametrize("percent", [50, 100, 200])
def test_latency_is_real_time_at_any_speed(percent: int) -> None:
    """14 ms of latency are 14 ms, and 9 ms late are 9 ms, at half the tempo as at twice the tempo."""
    score = Score.from_notes([Note(i * PPQ, Piece.SNARE) for i in range(4)], TempoMap.constant(120))
    lesson = Lesson(name="quarters", title="Quarters", score=score)
    options = PlanOptions(tempo_bpm=1.2 * percent, demonstrations=0, loops=1)
    practice = Session(plan_practice(lesson, options), Latency(input_ns=4 * NS_PER_MS, output_ns=10 * NS_PER_MS))
    practice.start()
    practice.handle(Started(ZERO_NS))
    beat_ns = BEAT_NS * 100 // percent
    for beat in range(4):
        practice.handle(Hit(ZERO_NS + (4 + beat) * beat_ns + 23 * NS_PER_MS, Piece.SNARE, Zone.HEAD, 80))
    assert [practice.verdicts[note].asynchrony_ns for note in range(4)] == [9 * NS_PER_MS] * 4
    practice.advance(ZERO_NS + 8 * beat_ns + TAIL_NS + 10 * NS_PER_MS)
    assert practice.result().alignment.asynchrony_ns.tolist() == [9 * NS_PER_MS] * 4


def test_a_session_that_was_stopped_judges_what_was_heard() -> None:
    practice = session()
    practice.handle(snare(0))
    practice.handle(snare(BEAT_NS))
    practice.advance(ZERO_NS + BAR_NS + 2 * BEAT_NS - 1)
    result = practice.result()
    assert not result.complete
    assert len(result.score) == 2
    assert result.alignment.count(Label.MATCH) == 2
    assert result.alignment.count(Label.MISS) == 0


@pytest.mark.parametrize("rate_hz", [1, 7, 60, 240])
def test_the_frame_rate_changes_nothing(rate_hz: int) -> None:
    played = [-20, 480, 1010, 1530, 1540]

    def outcome(step_ns: int) -> tuple[list[int], list[int]]:
        practice = session()
        hits = [snare(ms * NS_PER_MS) for ms in played]
        now_ns = ZERO_NS
        while not practice.over:
            now_ns += step_ns
            while hits and hits[0].at_ns <= now_ns:
                practice.handle(hits.pop(0))
            practice.advance(now_ns)
        live = dict(sorted(practice.verdicts.items()))
        return [v.asynchrony_ns or 0 for v in live.values()], practice.result().alignment.hit_of_note.tolist()

    assert outcome(NS_PER_S // rate_hz) == outcome(NS_PER_MS)


def test_of_two_kits_the_other_stays_when_one_goes() -> None:
    practice = session()
    for event in (DeviceFound(0, "TD-17"), DeviceFound(0, "Nitro"), DeviceLost(1, "TD-17")):
        practice.handle(event)
    assert practice.heard.devices == ["Nitro"]


def test_a_kit_that_goes_and_comes_is_told() -> None:
    practice = session()
    there = []
    for event in (DeviceFound(0, "TD-17"), DeviceLost(1, "TD-17")):
        practice.handle(event)
        there.append(tuple(practice.heard.devices))
    assert there == [("TD-17",), ()]
    assert [("gone" in text, "here" in text) for text in practice.heard.notices] == [(False, True), (True, False)]


KIT, OTHER, DAY = "TD-17", "Nitro", date(2026, 1, 2)
MEASURED = latency_of(
    Settings(input_latency_ms=9.0, output_latency_ms=2.0),
    StoredCalibration(
        {"card": MeasuredLatency(-3.0, 0.1, "loopback", DAY)},
        {
            KIT: DeviceLatency(
                MeasuredLatency(4.0, 0.5, "strike", DAY), {Piece.SNARE: MeasuredLatency(6.0, 0.5, "strike", DAY)}
            )
        },
    ),
)


@pytest.mark.parametrize(
    ("device", "piece", "output", "late_ms"),
    [
        (KIT, Piece.SNARE, "card", 6 - 3),
        (KIT, Piece.RIDE, "card", 4 - 3),  # no latency of its own: the kit's
        (OTHER, Piece.SNARE, "card", 9 - 3),  # not measured: what the settings say
        (KIT, Piece.SNARE, "headphones", 6 + 2),
        (KIT, Piece.SNARE, None, 6 + 2),
        (KEYBOARD, Piece.SNARE, "card", 0 - 3),  # keys are no kit
    ],
)
def test_each_device_and_pad_has_its_own_latency(device: str, piece: Piece, output: str | None, late_ms: int) -> None:
    lesson = Lesson(name="one", title="One", score=Score.from_notes([Note(0, piece)], TempoMap.constant(120)))
    practice = Session(plan_practice(lesson, PlanOptions(demonstrations=0, loops=1)), MEASURED)
    practice.handle(Started(ZERO_NS, output))
    (verdict,) = practice.handle(Hit(ZERO_NS + BAR_NS + late_ms * NS_PER_MS, piece, Zone.HEAD, 90, device=device))
    assert verdict.asynchrony_ns == 0


def test_an_output_that_changes_within_the_session_brings_its_own_latency() -> None:
    practice = session(MEASURED)
    for beat, (output, late_ms) in enumerate([(None, 2), ("card", -3), (None, -3), ("headphones", 2)]):
        practice.handle(Sounding(output))
        due_ns = ZERO_NS + BAR_NS + beat * BEAT_NS
        (verdict,) = practice.handle(Hit(due_ns + (6 + late_ms) * NS_PER_MS, Piece.SNARE, Zone.HEAD, 90, device=KIT))
        assert verdict.asynchrony_ns == 0
    assert practice.heard.output == "headphones"


def test_strokes_of_the_sticks_tell_which_hand_played() -> None:
    """Right, left, right, left; the sensors' clocks run 30 ms behind the pads."""
    practice = session(loops=3)
    for beat in range(12):
        hand = Limb.LEFT_HAND if beat % 2 else Limb.RIGHT_HAND
        uneven_ns = (beat * 37 % 11) * NS_PER_MS
        practice.handle(snare(beat * BEAT_NS + uneven_ns))
        at_ns = ZERO_NS + BAR_NS + beat * BEAT_NS + uneven_ns + 30 * NS_PER_MS
        practice.handle(StickStroke(at_ns, hand.name, hand, 2.0))
    result = practice.result()
    assert result.performance.hits["limb"].tolist() == [Limb.RIGHT_HAND, Limb.LEFT_HAND] * 6
    first_hit, first_stroke = result.felt[0]
    assert (first_hit.at_ns, first_stroke.at_ns) == (0, ZERO_NS + BAR_NS + 30 * NS_PER_MS)


def test_without_sensors_nobody_knows_the_hands() -> None:
    practice = session()
    practice.handle(snare(0))
    assert practice.result().performance.hits["limb"].tolist() == [Limb.UNKNOWN]
