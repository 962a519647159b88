"""A session's take: the student's strokes with their times, loudness and limbs, what became of them, and the click."""

import io
from dataclasses import replace
from datetime import date

import av
import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.events import Hit
from station.core.pieces import Limb, Piece, Zone, word
from station.core.sound_names import SoundName
from station.core.units import NS_PER_MS, NS_PER_S, PPQ
from station.drills.library import find_lesson
from station.music.performance import Performance
from station.practice.headless.virtual_session import practise_adaptively
from station.practice.session.adaptation import Adaptation
from station.practice.session.device_latency import Latency
from station.practice.session.plan import Plan, PlanOptions, plan_practice
from station.practice.session.session import SessionResult
from station.render.report.take.shown_take import ShownTake
from station.scenes.demonstrator import Demonstrator
from station.scenes.report.take_clicks import take_clicks
from station.scenes.report.take_clock import TakeClock
from station.scenes.report.take_media import shown_take, take_drummer
from station.scenes.report.take_notes import shown_passes, shown_strokes
from station.scenes.soundtrack import Sounds
from station.scoring.align import align
from station.scoring.matching.hit_windows import Level
from station.simulation.student_spec import parse_spec
from station.sound.drum_kit import DrumKit, Layer, Sound
from tests.fakes.glb_reader import GlbReader

LEAD_S = 3.0  # four beats at 80 a minute
BEAT_S = 0.75
PLAN = plan_practice(find_lesson("rock-1"), PlanOptions(loops=2, demonstrations=0, level=Level.INTERMEDIATE))
LATE, EARLY, MISSED, WRONG = 3, 6, 10, 13
"""Rows of the score, of the first pass."""
EXTRA_S = 4.0 + BEAT_S / 3


def played(plan: Plan, pace: float = 1.0, begins_s: float = 0.0) -> list[Hit]:
    """The strokes of a plan as they are written, so many times as slow, from a time on."""
    return [
        Hit(round((onset_s * pace + begins_s) * NS_PER_S), note.piece, note.zone, 60 + row % 50, openness=note.openness)
        for row, (onset_s, note) in enumerate(zip(plan.score.onset_s.tolist(), plan.score, strict=True))
    ]


def result_of(plan: Plan, hits: list[Hit], complete: bool = True, until_s: float = np.inf) -> SessionResult:
    score = plan.score if np.isinf(until_s) else plan.score.until_ns(round(until_s * NS_PER_S))
    performance = Performance.from_hits(hits)
    alignment = align(score, performance, clocked=plan.click is not None)
    return SessionResult(plan, score, performance, alignment, Latency(), complete, "kit")


def with_faults() -> SessionResult:
    hits = played(PLAN)
    hits[LATE] = replace(hits[LATE], at_ns=hits[LATE].at_ns + 30 * NS_PER_MS)
    hits[EARLY] = replace(hits[EARLY], at_ns=hits[EARLY].at_ns - 30 * NS_PER_MS)
    hits[WRONG] = replace(hits[WRONG], piece=Piece.FLOOR_TOM_1)
    extra = Hit(round(EXTRA_S * NS_PER_S), Piece.CRASH_1, Zone.EDGE, 111)
    return result_of(PLAN, [*(hit for row, hit in enumerate(hits) if row != MISSED), extra])


RESULT = with_faults()
CLOCK = TakeClock.of(RESULT)


def test_a_bar_of_count_in_comes_first() -> None:
    assert CLOCK.lead_ns == LEAD_S * NS_PER_S
    assert CLOCK.seconds_at([0, 4 * PPQ]) == pytest.approx([3.0, 6.0])


def test_the_strokes_are_the_student_s_with_what_became_of_them() -> None:
    strokes = shown_strokes(RESULT, CLOCK)
    assert [stroke.time_s for stroke in strokes] == pytest.approx(
        sorted(hit.at_ns / NS_PER_S + LEAD_S for hit in RESULT.performance)
    )
    others = [(s.node, s.velocity, s.state, round(s.time_s, 3)) for s in strokes if s.state != "match"]
    late_s, early_s, wrong_s = (float(PLAN.score.onset_s[row]) + LEAD_S for row in (LATE, EARLY, WRONG))
    assert others == [
        (word(PLAN.score[LATE].piece), 60 + LATE, "late", round(late_s + 0.030, 3)),
        (word(PLAN.score[EARLY].piece), 60 + EARLY, "early", round(early_s - 0.030, 3)),
        ("floor_tom_1", 60 + WRONG, "wrong_piece", round(wrong_s, 3)),
        ("crash_1", 111, "extra", round(EXTRA_S + LEAD_S, 3)),
    ]


def test_every_pass_has_its_notes_and_the_way_of_the_line() -> None:
    first, second = shown_passes(RESULT, CLOCK, 99.0)
    count = len(PLAN.section)
    assert sorted(note for note, _, _ in first.notes) == list(range(count))
    states = {note: state for note, _, state in first.notes if state != "match"}
    assert states == {LATE: "late", EARLY: "early", MISSED: "miss", WRONG: "wrong_piece"}
    assert {state for _, _, state in second.notes} == {"match"}
    when = {note: time_s for note, time_s, _ in first.notes}
    assert when[LATE] == pytest.approx(float(PLAN.score.onset_s[LATE]) + 0.030 + LEAD_S)
    assert when[MISSED] == pytest.approx(float(PLAN.score.onset_s[MISSED]) + LEAD_S)
    for one, begins_s in ((first, 3.0), (second, 9.0)):
        assert [time_s for time_s, _ in one.ticks] == pytest.approx([begins_s + k * BEAT_S for k in range(9)])
        assert [tick for _, tick in one.ticks] == [k * PPQ for k in range(9)]


def test_matches_are_played_by_the_limbs_of_their_notes_and_as_hard_and_open() -> None:
    drummer = take_drummer(RESULT, CLOCK, Demonstrator())
    score, limbs = drummer.score, drummer.assignment.limbs
    at = {
        (round(float(s), 3), int(p)): k
        for k, (s, p) in enumerate(zip(score.onset_s, score.notes["piece"], strict=True))
    }
    written = PLAN.section.notes["limb"]
    for row in range(len(PLAN.section)):
        if row in (LATE, EARLY, MISSED, WRONG):
            continue
        found = at[(round(float(PLAN.score.onset_s[row]) + LEAD_S, 3), int(PLAN.section.notes["piece"][row]))]
        assert score.notes["velocity"][found] == 60 + row
        if written[row] in (Limb.RIGHT_HAND, Limb.LEFT_HAND):
            assert limbs[found] == written[row]


def test_how_open_the_hi_hat_was_is_the_student_s() -> None:
    hits = [replace(hit, openness=0.75) if hit.piece is Piece.HIHAT else hit for hit in played(PLAN)]
    result = result_of(PLAN, hits)
    notes = take_drummer(result, TakeClock.of(result), Demonstrator()).score.notes
    assert (notes["openness"][notes["piece"] == Piece.HIHAT] == np.float32(0.75)).all()


def test_the_click_is_the_session_s_from_its_count_in_on() -> None:
    clicks = take_clicks(PLAN, CLOCK)
    assert (clicks["at_ns"] / NS_PER_S).tolist() == pytest.approx([k * BEAT_S for k in range(4 + 16)])


def test_without_a_click_the_line_goes_as_the_student_played() -> None:
    """They come in two seconds late and play a fifth slower than written."""
    plan = plan_practice(find_lesson("rock-1"), PlanOptions(loops=2, demonstrations=0, click=None))
    result = result_of(plan, played(plan, 1.2, 2.0))
    clock = TakeClock.of(result)
    first, second = shown_passes(result, clock, 99.0)
    wanted = [LEAD_S + 2.0 + 1.2 * k * BEAT_S for k in range(9)]
    assert [time_s for time_s, _ in first.ticks] == pytest.approx(wanted, abs=0.015)
    assert second.ticks[0][0] == pytest.approx(wanted[-1], abs=0.015)
    assert {state for _, _, state in first.notes} == {"match"}
    assert (take_clicks(plan, clock)["at_ns"] / NS_PER_S).tolist() == pytest.approx([k * BEAT_S for k in range(4)])
    beats_s = clock.tempo_map.seconds_at(clock.lead.end_tick + PPQ * np.arange(9))
    assert beats_s == pytest.approx(wanted, abs=0.03), "their head nods to their own beat"


def test_of_a_session_that_was_stopped_only_what_was_played_is_shown() -> None:
    hits = [hit for hit in played(PLAN) if hit.at_ns < 4 * NS_PER_S]
    take = made(result_of(PLAN, hits, complete=False, until_s=4.0))
    assert len(take.passes) == 1
    assert take.length_s == pytest.approx(LEAD_S + hits[-1].at_ns / NS_PER_S + 1.5)


def test_a_session_without_a_stroke_is_shown_all_the_same() -> None:
    take = made(result_of(PLAN, []))
    assert take.strokes == ()
    assert {state for one in take.passes for _, _, state in one.notes} == {"miss"}


def made(result: SessionResult) -> ShownTake:
    return shown_take(result, Demonstrator(), Sounds(noise_kit(), None))


def noise_kit() -> DrumKit:
    """Every sound is noise that begins at once and lasts 10 ms."""
    frames = (0.4 * np.random.default_rng(2).normal(size=(480, 2)).clip(-2, 2)).astype(np.float32)
    return DrumKit("noise", 48_000, {name: Sound((Layer(127, (frames,)),)) for name in SoundName})


@pytest.fixture(scope="module")
def take() -> ShownTake:
    return made(RESULT)


def test_sound_and_model_have_every_stroke_at_its_time(take: ShownTake) -> None:
    sound = np.abs(heard(take.sound)).max(axis=1)
    assert len(sound) / 48_000 == pytest.approx(take.length_s, abs=0.001)
    keys = {name: GlbReader(take.model).times_of(name) for name in ("right_stick", "left_stick", "beater", "crash_1")}
    every = np.unique(np.concatenate(list(keys.values())))
    for stroke in take.strokes:
        start = round(stroke.time_s * 48_000)
        assert sound[start : start + 144].max() > 0.05, "within 3 ms it is heard"
        assert np.abs(every - stroke.time_s).min() < 0.001
    first = round(take.strokes[0].time_s * 48_000)
    assert sound[: first - 144].max() < 0.02, "and nothing before the first"


def heard(data: bytes) -> NDArray[np.float32]:
    with av.open(io.BytesIO(data)) as container:
        frames = [(frame.pts * frame.time_base, frame.to_ndarray().T) for frame in container.decode(audio=0)]
    return np.concatenate([block[max(0, -round(float(at_s) * 48_000)) :] for at_s, block in frames])


def test_extras_are_told_in_words(take: ShownTake) -> None:
    assert take.remark == "Strokes that no note answers, heard and seen here too: 1 crash."


def test_the_views_look_at_the_kit_from_where_they_say(take: ShownTake) -> None:
    """In glTF's axes the drummer faces +z, and their left is +x."""
    eyes = {view.name: view.eye for view in take.views}
    assert list(eyes) == ["Front", "Over the shoulder", "Hi-hat side", "From above"]
    assert eyes["Front"][2] > 1.5
    assert eyes["Over the shoulder"][2] < -0.5
    assert eyes["Hi-hat side"][0] > 1.5
    assert eyes["From above"][1] > 2.0


def test_it_does_not_matter_how_a_kit_rattles() -> None:
    """Double triggers, twenty strokes at once, and pieces that the drummer's kit has not: all is shown and heard."""
    rng = np.random.default_rng(8)
    hits = played(PLAN)
    for piece in Piece:
        hits += [
            Hit(round(float(at_s) * NS_PER_S), piece, Zone.HEAD, 90) for at_s in (5.0, 5.003, rng.uniform(-0.2, 12.9))
        ]
    result = result_of(PLAN, hits)
    take = made(result)
    assert len(take.strokes) == len(hits)
    assert all(GlbReader(take.model).has(stroke.node) for stroke in take.strokes)


def test_passes_that_follow_the_student_have_a_click_each_and_silence_between() -> None:
    """Two passes of the two bars at 56 beats a minute or more, a whole silent bar or more between."""
    adaptation = Adaptation(find_lesson("rock-1"), PlanOptions(demonstrations=0, loops=2), date(2026, 1, 2))
    result = practise_adaptively(adaptation, parse_spec("seed=1")).result
    clock = TakeClock.of(result)
    passes = shown_passes(result, clock, 99.0)
    assert [[note for note, _, _ in one.notes] for one in passes] == [list(range(len(PLAN.section)))] * 2
    assert {state for one in passes for _, _, state in one.notes} == {"match"}
    first, second = passes
    assert second.ticks[0][0] > first.ticks[-1][0] + 1.0
    clicks_s = take_clicks(result.plan, clock)["at_ns"] / NS_PER_S
    for one in passes:
        for time_s, _ in one.ticks[:-1]:
            assert np.abs(clicks_s - time_s).min() < 1e-6
