"""The timeline of a session, counted by hand: a two-bar lesson at 120 bpm, so that a bar lasts two seconds."""

from dataclasses import replace

import numpy as np
import pytest

from station.core.errors import BadInput
from station.core.pieces import Limb, Piece, Zone
from station.core.settings import Settings
from station.core.units import NS_PER_S, PPQ
from station.drills.lesson import Lesson
from station.engine.messages import Bus, ClickVoice
from station.motion.kit.kit import load_kit
from station.motion.sticking.hand_notes import Hands
from station.music.score import Note, Score
from station.music.tempo import MeterChange, TempoChange, TempoMap
from station.practice.session.cues.click_pattern import ClickBeats, ClickPattern
from station.practice.session.cues.quiet_bars import Gap
from station.practice.session.leading_hand import hands_of
from station.practice.session.plan import Phase, PlanOptions, plan_practice
from tests.fakes.scores import rock_beat

BAR_NS = 2 * NS_PER_S


def lesson(score: Score | None = None) -> Lesson:
    return Lesson(
        name="two-bars",
        title="Two bars",
        score=score or rock_beat(2),
        loop=(0, 1),
        passes=3,
        count_in_bars=1,
        demonstrations=2,
    )


def test_count_in_demonstrations_count_in_passes() -> None:
    plan = plan_practice(lesson(), PlanOptions())
    assert [(s.phase, s.index, s.start_ns // BAR_NS, s.end_ns // BAR_NS) for s in plan.segments] == [
        (Phase.COUNT_IN, 0, 0, 1),
        (Phase.DEMONSTRATION, 0, 1, 3),
        (Phase.DEMONSTRATION, 1, 3, 5),
        (Phase.COUNT_IN, 0, 5, 6),
        (Phase.PASS, 0, 6, 8),
        (Phase.PASS, 1, 8, 10),
        (Phase.PASS, 2, 10, 12),
    ]
    assert plan.passes_start_ns == 6 * BAR_NS
    assert plan.end_ns == 12 * BAR_NS
    assert len(plan.score) == 3 * 2 * 13


def test_clicks_sound_on_every_beat_and_accent_the_first() -> None:
    plan = plan_practice(lesson(), PlanOptions(demonstrations=0, loops=1))
    clicks = plan.cues[plan.cues["bus"] == Bus.CLICK]
    assert clicks["at_ns"].tolist() == [i * NS_PER_S // 2 for i in range(3 * 4)]
    accents = np.flatnonzero(clicks["piece"] == ClickVoice.ACCENT)
    assert accents.tolist() == [0, 4, 8]


def test_the_students_click_is_for_the_passes_and_the_count_in_stays_plain() -> None:
    click = ClickPattern(beats=ClickBeats.BACKBEAT, gap=Gap(1, 1))
    plan = plan_practice(lesson(), PlanOptions(demonstrations=0, loops=2, click=click))
    clicks = plan.cues[plan.cues["bus"] == Bus.CLICK]
    # a bar of four counted in, then bars of which every second is quiet and the others click on 2 and 4
    beats = [0, 1, 2, 3, 5, 7, 13, 15]
    assert clicks["at_ns"].tolist() == [beat * NS_PER_S // 2 for beat in beats]


def test_the_count_in_leaves_room_for_a_pickup() -> None:
    tempo_map = TempoMap.build([TempoChange.from_bpm(0, 120.0)], [MeterChange(0, 1, 4), MeterChange(PPQ, 4, 4)])
    score = Score.from_notes([Note(0, Piece.SNARE, Zone.HEAD), Note(PPQ, Piece.KICK, Zone.HEAD)], tempo_map, 5 * PPQ)
    plan = plan_practice(lesson(score), PlanOptions(demonstrations=0, loops=1, bars=(1, 2)))
    assert plan.passes_start_ns == 3 * NS_PER_S // 2  # one two three; the pickup falls on four


def test_only_demonstrations_sound_strokes() -> None:
    plan = plan_practice(lesson(), PlanOptions(demonstrations=1))
    strokes = plan.cues[plan.cues["bus"] == Bus.DEMONSTRATION]
    assert len(strokes) == 2 * 13
    assert strokes["at_ns"].min() == BAR_NS
    assert strokes["at_ns"].max() < 3 * BAR_NS


def test_a_guide_plays_every_stroke_of_every_pass() -> None:
    plain = plan_practice(lesson(), PlanOptions(demonstrations=1, loops=3))
    guided = plan_practice(lesson(), PlanOptions(demonstrations=1, loops=3, guide=True))
    strokes, more = (plan.cues[plan.cues["bus"] == Bus.DEMONSTRATION]["at_ns"] for plan in (plain, guided))
    assert len(more) == len(strokes) + len(plain.score)
    assert more[len(strokes) :].tolist() == (plain.passes_start_ns + plain.score.onset_ns).tolist()


def test_a_grabbed_cymbal_is_a_cue_of_velocity_0() -> None:
    crash = Note(0, Piece.CRASH_1, Zone.EDGE, velocity=100, choke_ticks=PPQ)
    one_bar = lesson(Score.from_notes([crash], TempoMap.constant(120)))
    plan = plan_practice(replace(one_bar, loop=(0, 0)), PlanOptions(demonstrations=1))
    strokes = plan.cues[plan.cues["bus"] == Bus.DEMONSTRATION]
    assert strokes["velocity"].tolist() == [100, 0]
    assert strokes["at_ns"].tolist() == [BAR_NS, BAR_NS + NS_PER_S // 2]


def test_tempo_bars_and_loops_are_the_students_to_choose() -> None:
    plan = plan_practice(lesson(), PlanOptions(tempo_bpm=60, bars=(2, 2), loops=2, demonstrations=0))
    assert plan.first_bar == 1
    assert plan.section.bar_count == 1
    assert plan.end_ns == 3 * 2 * BAR_NS  # a bar of count-in and two of one bar, twice as long at half the tempo


def test_segment_at_any_time() -> None:
    plan = plan_practice(lesson(), PlanOptions())
    assert plan.segment_at(-1).phase is Phase.COUNT_IN
    assert plan.segment_at(6 * BAR_NS) == plan.segments[4]
    assert plan.segment_at(12 * BAR_NS).phase is Phase.OVER


@pytest.mark.parametrize(
    ("options", "named"),
    [
        (PlanOptions(tempo_bpm=0), "--tempo: 0"),
        (PlanOptions(tempo_bpm=-80), "--tempo: -80"),
        (PlanOptions(tempo_bpm=float("nan")), "--tempo: nan"),
        (PlanOptions(tempo_bpm=1e9), "--tempo: 1e"),
        (PlanOptions(loops=0), "--loops: 0"),
        (PlanOptions(bars=(0, 1)), "--bars: 0-1"),
        (PlanOptions(bars=(2, 1)), "--bars: 2-1: expected the first bar first"),
        (PlanOptions(bars=(1, 3)), "--bars: 1-3"),
    ],
)
def test_what_cannot_be_is_refused(options: PlanOptions, named: str) -> None:
    with pytest.raises(BadInput, match=named):
        plan_practice(lesson(), options)


def test_a_left_handed_student_plays_the_kit_mirrored_and_an_open_handed_one_uncrossed() -> None:
    """Hi-hat and snare of a rock beat: who leads has the hat; open, the other hand."""
    expected = {
        Hands.RIGHT: (False, Limb.RIGHT_HAND, Limb.RIGHT_FOOT),
        Hands.LEFT: (True, Limb.LEFT_HAND, Limb.LEFT_FOOT),
        Hands.OPEN: (False, Limb.LEFT_HAND, Limb.RIGHT_FOOT),
    }
    for hands, (mirrored, hat, kick) in expected.items():
        plan = plan_practice(lesson(), PlanOptions(hands=hands))
        notes = plan.section.notes
        assert plan.kit.left_handed is mirrored
        assert set(notes["limb"][notes["piece"] == Piece.HIHAT].tolist()) == {hat}
        assert set(notes["limb"][notes["piece"] == Piece.KICK].tolist()) == {kick}


def test_a_kit_that_is_built_for_the_student_s_hand_is_not_mirrored() -> None:
    left = replace(lesson(), kit="left_handed")
    assert plan_practice(left, PlanOptions()).kit.left_handed
    assert plan_practice(left, PlanOptions(hands=Hands.LEFT)).kit == load_kit("left_handed")
    own = PlanOptions(hands=Hands.LEFT, stands="electronic")
    assert plan_practice(left, own).kit.pieces == load_kit("left_handed_electronic").pieces
    assert plan_practice(left, PlanOptions(stands="jazz")).kit == load_kit("jazz")
    assert not plan_practice(left, PlanOptions(hands=Hands.RIGHT)).kit.left_handed


def test_a_word_that_is_no_hand_is_named() -> None:
    assert hands_of(Settings()) is None
    assert hands_of(Settings(hands="open")) is Hands.OPEN
    with pytest.raises(BadInput, match="hands: expected one of right, left, open"):
        hands_of(Settings(hands="both"))
