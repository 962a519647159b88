"""Pauses, by hand: bars of four quarters on the snare at 120 bpm, a bar lasts two seconds, after a bar of count-in."""

import numpy as np
import pytest

from station.core.events import Choke, Hit
from station.core.pieces import Piece, Zone
from station.core.units import NS_PER_MS, NS_PER_S, PPQ
from station.drills.lesson import Lesson
from station.engine.messages import Bus, Play, Started, Stop
from station.music.judgement import Label
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from station.practice.session.cues.click_pattern import PLAIN, ClickPattern
from station.practice.session.pausing import NEAR_NS, Silence
from station.practice.session.plan import TAIL_NS, Phase, Plan, PlanOptions, plan_practice
from station.practice.session.session import Session

BAR_NS, BEAT_NS = 2 * NS_PER_S, NS_PER_S // 2
ZERO_NS = 50 * NS_PER_S
AGAIN_NS = 100 * NS_PER_S
"""When the transport's zero is heard after the pause: the score begins there a bar later."""


def plan_of(loops: int, rests: int = 0, click: ClickPattern | None = PLAIN) -> Plan:
    """A bar of quarters, `rests` empty bars behind it."""
    notes = [Note(i * PPQ, Piece.SNARE) for i in range(4)]
    score = Score.from_notes(notes, TempoMap.constant(120), (1 + rests) * 4 * PPQ)
    lesson = Lesson(name="quarters", title="Quarters", score=score, loop=(0, rests))
    return plan_practice(lesson, PlanOptions(demonstrations=0, loops=loops, click=click))


def started(loops: int = 6) -> Session:
    session = Session(plan_of(loops))
    session.start()
    session.handle(Started(ZERO_NS))
    return session


def at(score_ns: int, zero_ns: int = ZERO_NS, from_ns: int = 0) -> int:
    """Session time of a place in the score, in the run that begins at `from_ns` of it."""
    return zero_ns + BAR_NS + score_ns - from_ns


def snare(at_ns: int) -> Hit:
    return Hit(at_ns, Piece.SNARE, Zone.HEAD, 80)


def play_bars(session: Session, first: int, last: int, zero_ns: int = ZERO_NS, from_ns: int = 0) -> None:
    for beat in range(4 * first, 4 * last):
        session.handle(snare(at(beat * BEAT_NS, zero_ns, from_ns)))


def test_two_bars_with_notes_and_no_stroke_mean_that_the_student_has_stopped() -> None:
    silence = Silence(plan_of(3).score)
    assert silence.bars(None, 0, 2 * BAR_NS + NEAR_NS) == 2
    assert silence.bars(None, 0, 2 * BAR_NS) == 1, "a late stroke may still come"
    assert silence.bars(BAR_NS // 2, 0, 3 * BAR_NS + NEAR_NS) == 2, "the bar of the last stroke is none of them"
    assert silence.bars(BAR_NS - 30 * NS_PER_MS, 0, 3 * BAR_NS + NEAR_NS) == 1, "an early downbeat is the next bar's"


def test_bars_without_notes_are_no_silence() -> None:
    """Bars 1, 3 and 5 have notes, 2, 4 and 6 have none."""
    silence = Silence(plan_of(3, rests=1).score)
    assert silence.bars(1, 0, 4 * BAR_NS + NEAR_NS) == 1
    assert silence.bars(1, 0, 5 * BAR_NS + NEAR_NS) == 2


def test_who_stops_is_noticed_and_nothing_of_the_silence_is_scored() -> None:
    session = started()
    play_bars(session, 0, 2)
    left = []
    for now_ns in (at(4 * BAR_NS + NEAR_NS - 1), at(4 * BAR_NS + NEAR_NS)):
        session.advance(now_ns)
        left.append(session.is_left)
    assert left == [False, True]
    assert session.pause()[-1] == Stop()
    result = session.result()
    assert not result.complete
    assert (len(result.score), len(result.performance)) == (8, 8)


@pytest.mark.parametrize("looks", [1, 60])
def test_however_often_anybody_looks_the_silence_is_the_same(looks: int) -> None:
    """Bar 1 is played, bars 2 and 3 are not, and a beat into bar 4 the student comes back."""
    session = started()
    session.waits = True
    play_bars(session, 0, 1)
    if looks > 1:
        for look in range(looks):
            session.advance(at(BAR_NS + 3 * BAR_NS * look // looks))
            if session.is_left:
                session.pause()
    session.handle(snare(at(3 * BAR_NS + BEAT_NS)))
    session.handle(snare(at(3 * BAR_NS + 2 * BEAT_NS)))
    session.advance(at(3 * BAR_NS + 3 * BEAT_NS))
    assert session.is_left or session.paused
    session.pause()
    assert len(session.result().performance) == 4
    session.resume()
    assert session.pauses[0].bar == 0


def test_it_goes_on_from_the_bar_of_the_last_stroke_behind_a_bar_of_count_in() -> None:
    session = started()
    play_bars(session, 0, 1)
    session.handle(snare(at(BAR_NS + 10 * NS_PER_MS)))  # one stroke of the second bar
    session.advance(at(5 * BAR_NS))
    session.pause()
    assert session.handle(snare(at(5 * BAR_NS) + 1)) == (), "in a pause nothing is judged"
    _, play = session.resume(asked=False)
    assert isinstance(play, Play)
    clicks = play.cues[play.cues["bus"] == Bus.CLICK]["at_ns"]
    assert clicks[:5].tolist() == [k * BEAT_NS for k in range(5)]
    assert len(clicks) == 4 + 5 * 4, "a bar of count-in, five bars are left of six"
    assert session.state().score_ns == BAR_NS, "it stands until the transport runs"
    session.handle(Started(AGAIN_NS))
    session.advance(AGAIN_NS + BAR_NS // 2)
    assert session.state().segment.phase is Phase.COUNT_IN
    session.handle(snare(AGAIN_NS + BAR_NS // 2))  # an air stroke in the count-in
    session.advance(at(BAR_NS, AGAIN_NS, BAR_NS))
    assert session.state().segment.phase is Phase.PASS
    play_bars(session, 1, 6, AGAIN_NS, BAR_NS)
    session.advance(at(6 * BAR_NS, AGAIN_NS, BAR_NS) + TAIL_NS)
    assert session.over
    result = session.result()
    assert result.complete
    assert len(result.score) == 24
    assert result.performance.hits["at_ns"].tolist() == (np.arange(24) * BEAT_NS).tolist(), "every note once, as last"
    assert (result.alignment.note_label == Label.MATCH).all()
    assert [(pause.bar, pause.asked, pause.strokes) for pause in result.pauses] == [(1, False, 1)]


def test_a_stroke_belongs_to_the_bar_of_the_note_that_it_answers() -> None:
    """The last note of bar 1 late, the first of bar 2 early, by 40 ms both: only the second is taken back."""
    session = started()
    play_bars(session, 0, 1)
    session.handle(snare(at(BAR_NS - 40 * NS_PER_MS)))
    session.handle(snare(at(BAR_NS + BEAT_NS)))
    session.pause()
    session.resume()
    assert [hit.at_ns for hit in session.hits] == [0, BEAT_NS, 2 * BEAT_NS, 3 * BEAT_NS]
    assert session.pauses[0].strokes == 2
    assert sorted(session.verdicts) == [0, 1, 2, 3]


def test_the_strokes_that_ask_for_the_pause_were_not_played() -> None:
    session = started()
    play_bars(session, 0, 2)
    crashes = [Hit(at(BAR_NS + BEAT_NS), piece, Zone.EDGE, 90) for piece in (Piece.CRASH_1, Piece.CRASH_2)]
    for crash in crashes:
        session.handle(crash)
    session.pause(crashes)
    result = session.result()
    assert set(result.performance.hits["piece"].tolist()) == {Piece.SNARE}
    assert (result.alignment.hit_label == Label.MATCH).all()


def test_chokes_are_taken_back_too() -> None:
    session = started()
    play_bars(session, 0, 2)
    for score_ns in (BEAT_NS, BAR_NS + BEAT_NS):
        session.handle(Choke(at(score_ns), Piece.CRASH_1))
    session.pause()
    session.resume()
    assert session.result().performance.chokes["at_ns"].tolist() == [BEAT_NS]


def test_the_whole_again_where_the_whole_is_measured() -> None:
    session = started()
    play_bars(session, 0, 3)
    session.pause()
    session.resume(whole=True)
    assert not session.hits
    assert session.pauses[0].bar == 0


def test_a_pause_in_the_count_in_begins_the_passes_anew() -> None:
    session = started()
    session.advance(ZERO_NS + BAR_NS // 2)
    assert session.can_pause
    session.pause()
    _, play = session.resume()
    assert isinstance(play, Play)
    session.handle(Started(AGAIN_NS))
    session.handle(snare(at(0, AGAIN_NS)))
    assert [hit.at_ns for hit in session.hits] == [0]


def test_without_a_click_the_score_waits_by_itself() -> None:
    session = Session(plan_of(4, click=None))
    session.start()
    session.handle(Started(ZERO_NS))
    session.advance(at(20 * BAR_NS))
    assert (session.can_pause, session.is_left, session.pause()) == (False, False, ())
    session.waits = True
    for at_ns in (0, 20 * BAR_NS):
        session.handle(snare(at(at_ns)))
    assert len(session.hits) == 2


def test_no_pause_before_the_transport_runs_nor_in_a_pause() -> None:
    session = Session(plan_of(4))
    assert session.pause() == ()
    assert session.resume() == ()
    session.handle(Started(ZERO_NS))
    session.advance(at(BAR_NS))
    assert session.pause()
    assert session.pause() == ()


@pytest.mark.parametrize("counts", [False, True])
def test_a_counted_word_before_the_bar_line_is_not_lost(counts: bool) -> None:
    session = Session(plan_of(2, click=ClickPattern(counts=counts)))
    session.start()
    session.handle(Started(ZERO_NS))
    play_bars(session, 0, 1)
    session.pause()
    _, play = session.resume()
    assert isinstance(play, Play)
    assert len(play.cues) == 4 + 8
