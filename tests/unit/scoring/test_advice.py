"""Advice on takes of people who do one thing wrong, on music whose bars repeat; who does what is told by hand here.

The players are `tests.fakes.human_takes`: they scatter, lean and stand off the click as anyone does. Sizes are those
that a teacher minds, or little more.
"""

from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.pieces import Dynamic, Limb, Ornament, Piece, Zone
from station.core.units import PPQ
from station.music.judgement import Label
from station.music.performance import Performance
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from station.scoring.analysis.fault_table import FAULTS, STICK_FAULTS, Asked
from station.scoring.analysis.summary import Summary, SummaryView, summarise
from station.scoring.matching.alignment import Alignment, Reference
from station.scoring.report.advice import Advice, advise
from station.scoring.report.praise import praise
from tests.fakes.human_takes import Added, Human, human_hits, human_take
from tests.fakes.scores import beat_and_fill, double_strokes, flams, swing_ride

R, L = Limb.RIGHT_HAND, Limb.LEFT_HAND
SEEDS = range(6)


def backbeat(bars: int = 16, tempo_bpm: float = 110.0) -> Score:
    """Eighths of the right hand on the hat, kick on 1 and 3, left hand on 2 and 4 on the snare: 12 strokes a bar."""
    notes = [Note(i * PPQ // 2, Piece.HIHAT, Zone.BOW, 80, openness=0.0, limb=R) for i in range(8)]
    notes += [Note(beat * PPQ, Piece.KICK, velocity=90, limb=Limb.RIGHT_FOOT) for beat in (0, 2)]
    notes += [Note(beat * PPQ, Piece.SNARE, velocity=90, limb=L) for beat in (1, 3)]
    return Score.from_notes(notes, TempoMap.constant(tempo_bpm)).repeated(bars)


def sixteenths(bars: int = 8) -> Score:
    """Sixteenths on the snare by turns, an accent on every beat and a ghost after it, at 80 bpm."""
    classes = {0: (Dynamic.ACCENT, 112), 1: (Dynamic.GHOST, 32)}
    notes = [
        Note(i * PPQ // 4, Piece.SNARE, limb=(R, L)[i % 2], dynamic=dynamic, velocity=velocity)
        for i in range(16)
        for dynamic, velocity in [classes.get(i % 4, (Dynamic.NORMAL, 75))]
    ]
    return Score.from_notes(notes, TempoMap.constant(80)).repeated(bars)


BEAT, FILL, SWING, TURNS = backbeat(), beat_and_fill(8), swing_ride(16), sixteenths()
DOUBLES, FLAMS = double_strokes(16), flams(16)


def of(score: Score, piece: Piece) -> NDArray[np.bool_]:
    return np.asarray(score.notes["piece"] == piece)


def beside_the_beat(score: Score) -> NDArray[np.bool_]:
    return np.asarray(score.notes["tick"] % PPQ > 0)


def in_bar(score: Score) -> NDArray[np.int64]:
    """Ticks since the bar began; all these scores are in four."""
    return np.asarray(score.notes["tick"] % (4 * PPQ))


TOMS = np.isin(FILL.notes["piece"], (Piece.TOM_1, Piece.TOM_2, Piece.FLOOR_TOM_1))
"""The last two beats of every fourth bar; they lead to the one after."""
LANDED = (FILL.bar % 4 == 0) & (FILL.bar > 0) & (in_bar(FILL) < PPQ)
SECOND = in_bar(DOUBLES) // (PPQ // 4) % 2 == 1

PLANTED: Mapping[str, tuple[Score, Added]] = {
    "early_hihat": (BEAT, Added(shift_ms=-45.0 * of(BEAT, Piece.HIHAT))),
    "late_kick": (BEAT, Added(shift_ms=30.0 * of(BEAT, Piece.KICK))),
    "early_snare": (BEAT, Added(shift_ms=-30.0 * of(BEAT, Piece.SNARE))),
    "late_offbeats": (BEAT, Added(shift_ms=35.0 * beside_the_beat(BEAT))),
    "late_left_hand": (TURNS, Added(shift_ms=25.0 * (TURNS.notes["limb"] == L))),
    "straight_swing": (SWING, Added(shift_ms=-40.0 * beside_the_beat(SWING))),
    "hard_swing": (SWING, Added(shift_ms=35.0 * beside_the_beat(SWING))),
    "slow_hihat_foot": (SWING, Added(shift_ms=30.0 * of(SWING, Piece.HIHAT_PEDAL))),
    "rush_fills": (FILL, Added(shift_ms=-45.0 * TOMS * (in_bar(FILL) / PPQ - 1.75) / 2)),
    "fill_lands_late": (FILL, Added(shift_ms=40.0 * LANDED)),
    "lazy_doubles": (DOUBLES, Added(shift_ms=50.0 * SECOND)),
    "weak_doubles": (DOUBLES, Added(level_db=-4.0 * SECOND)),
    "unsteady_left_hand": (BEAT, Added(scatter=np.where(of(BEAT, Piece.SNARE), 2.8, 1.0))),
    "weak_left": (TURNS, Added(level_db=-4.0 * (TURNS.notes["limb"] == L))),
    "flat_accents": (TURNS, Added(level_db=-4.0 * (TURNS.notes["dynamic"] == Dynamic.ACCENT))),
    "loud_ghosts": (TURNS, Added(level_db=8.0 * (TURNS.notes["dynamic"] == Dynamic.GHOST))),
    "loud_graces": (FLAMS, Added(level_db=14.0 * FLAMS.is_grace)),
    "tight_flams": (FLAMS, Added(shift_ms=22.0 * FLAMS.is_grace)),
    "fades": (BEAT, Added(level_db=np.linspace(0.0, -7.0, len(BEAT)))),
    "grows": (TURNS, Added(level_db=np.linspace(-10.0, -3.0, len(TURNS)))),
    "early": (BEAT, Added(shift_ms=-30.0)),
}


def named(said: tuple[Advice, ...], fault: str) -> bool:
    """Whether the fault is said first, itself or as what the data do not tell from it."""
    return bool(said) and fault in (said[0].fault, *said[0].alternatives)


@pytest.mark.parametrize("fault", PLANTED)
def test_what_a_teacher_hears_at_once_is_said_first(fault: str) -> None:
    score, added = PLANTED[fault]
    said = [advise(human_take(score, seed, added)) for seed in SEEDS]
    assert sum(named(one, fault) for one in said) >= len(SEEDS) - 1, [[a.fault for a in one] for one in said]


@pytest.mark.parametrize("fault", PLANTED)
def test_any_word_can_be_muted_or_sized_away(fault: str) -> None:
    """A size that no fault here comes near; of some words it is what there must be at least."""
    score, added = PLANTED[fault]
    must_be_there = fault in ("flat_accents", "loud_ghosts", "loud_graces", "tight_flams")
    for size in (None, 0.1 if must_be_there else 500.0):
        view = SummaryView(faults=Asked({fault: size}))
        assert fault not in [one.fault for one in advise(human_take(score, 1, added, view=view))]


def test_a_teachers_hint_comes_with_its_fault() -> None:
    score, added = PLANTED["late_kick"]
    view = SummaryView(hints={"late_kick": "Heel up.", "early_kick": "Wait."})
    assert [(one.fault, one.hint) for one in advise(human_take(score, 1, added, view=view))] == [
        ("late_kick", "Heel up.")
    ]


@pytest.mark.parametrize(
    ("parts", "bars"),
    [
        ({}, "bars 20, 24 and 28"),
        ({19: "fill", 23: "fill", 27: "way out"}, "bars 20, 24 (fill) and 28 (way out)"),
        ({23: "fill", 0: "intro"}, "bars 20, 24 (fill) and 28"),
    ],
)
def test_bars_are_named_as_the_lesson_names_them(parts: dict[int, str], bars: str) -> None:
    """Every fourth bar is a fill."""
    score, added = PLANTED["rush_fills"]
    text = advise(human_take(score, 1, added, view=SummaryView(parts=parts)))[0].text
    assert f", most in {bars}: loop the fill" in text


@pytest.mark.parametrize(
    ("score", "clocked"),
    [(score, True) for score in (BEAT, FILL, SWING, TURNS, DOUBLES, FLAMS)] + [(BEAT, False), (FILL, False)],
)
def test_nothing_is_said_of_people_without_fault(score: Score, clocked: bool) -> None:
    """Without a click only of music in which one can tell where a bar begins."""
    for seed in SEEDS:
        for sd_ms in (10.0, 18.0):
            assert advise(human_take(score, seed, human=Human(sd_ms), clocked=clocked)) == ()


@pytest.mark.parametrize("clocked", [True, False])
def test_the_innocent_are_not_blamed(clocked: bool) -> None:
    """The hi-hat 45 ms early, all else on time: not a word of snare, kick or left hand."""
    for seed in SEEDS:
        added = Added(shift_ms=-45.0 * of(BEAT, Piece.HIHAT))
        said = advise(human_take(BEAT, seed, added, clocked=clocked))
        assert [one.fault for one in said] == ["early_hihat"]


def test_what_the_data_cannot_tell_is_said_with_its_alternative() -> None:
    """The right hand plays the hat and nothing else: one is named, the other comes with it, in the text as well."""
    (said,) = advise(human_take(BEAT, 1, Added(shift_ms=-45.0 * of(BEAT, Piece.HIHAT))))
    assert said.alternatives == ("early_right_hand",)
    assert "(or your right hand" in said.text


def test_two_faults_are_said_together() -> None:
    added = Added(shift_ms=35.0 * of(BEAT, Piece.KICK), level_db=np.linspace(0.0, -8.0, len(BEAT)))
    for seed in SEEDS:
        assert [one.fault for one in advise(human_take(BEAT, seed, added))] == ["late_kick", "fades"]


def test_of_three_faults_two_are_said_and_notes_come_first() -> None:
    """A snare that is left out in half its places, a late kick, a fade."""
    rng = np.random.default_rng(2)
    added = Added(
        shift_ms=40.0 * of(BEAT, Piece.KICK),
        level_db=np.linspace(0.0, -8.0, len(BEAT)),
        left_out=of(BEAT, Piece.SNARE) & (rng.random(len(BEAT)) < 0.5),
    )
    assert [one.fault for one in advise(human_take(BEAT, 1, added))] == ["missed", "late_kick"]


@pytest.mark.parametrize(("percent", "fault"), [(5.0, "rushing"), (-5.0, "dragging")])
def test_a_tempo_that_creeps_is_said_without_a_click(percent: float, fault: str) -> None:
    """By 5 % in eight bars, which last 17.5 s."""
    rate = percent / 100 / (8 * 4 * 60 / 110)

    def course(at_s: NDArray[np.float64]) -> NDArray[np.float64]:
        return at_s - rate * at_s**2 / 2

    for seed in SEEDS:
        (said,) = advise(human_take(BEAT, seed, Added(course=course), clocked=False))
        assert said.fault == fault
        assert abs(said.effect) == pytest.approx(5.0, abs=1.2)


def openness_of(share: float, written: float, played: float) -> Summary:
    """A beat of which `share` of the hats are `played` so where all are `written` so."""
    wrong = of(BEAT, Piece.HIHAT) & (np.random.default_rng(4).random(len(BEAT)) < share)
    rows = BEAT.notes.copy()
    rows["openness"][of(BEAT, Piece.HIHAT)] = written
    score = Score(rows, BEAT.tempo_map, BEAT.end_tick)
    return human_take(score, 3, Added(openness=np.where(wrong, played, rows["openness"])))


def test_hats_that_are_open_or_closed_where_they_should_not_be() -> None:
    assert advise(openness_of(0.25, 0.0, 0.8))[0].fault == "open_hats"
    assert advise(openness_of(0.25, 1.0, 0.0))[0].fault == "closed_hats"
    assert advise(openness_of(0.05, 0.0, 0.8)) == ()


# --- the way through --------------------------------------------------------------------------------------------------


FORM = backbeat(8)
BAR_S = 4 * 60 / 110


def joined(seed: int, until_s: float, silence_s: float, again_s: float) -> Summary:
    """`FORM` up to a time, silence, then from another time of it on; where each hit lies is known and not looked for.

    Of what was played twice the later attempt answers the notes.
    """
    whole, rows = human_hits(FORM, seed), np.arange(len(FORM))
    due_s = FORM.onset_s
    first, later = rows[due_s < until_s - 1e-6], rows[due_s >= again_s - 1e-6]
    note = np.concatenate([first, later])
    hits = whole[note]
    place_ns = hits["at_ns"].astype(np.int64)
    hits["at_ns"][len(first) :] += round((until_s + silence_s - again_s) * 1e9)
    order = np.argsort(hits["at_ns"], kind="stable")
    note, hits, place_ns = note[order], hits[order], place_ns[order]
    hit_of_note = np.full(len(FORM), -1)
    hit_of_note[note] = np.arange(len(note))
    note_of_hit = np.where(hit_of_note[note] == np.arange(len(note)), note, -1)
    paired = hit_of_note >= 0
    alignment = Alignment(
        hit_of_note=hit_of_note,
        note_of_hit=note_of_hit,
        note_label=np.where(paired, Label.MATCH, Label.MISS).astype(np.uint8),
        hit_label=np.where(note_of_hit >= 0, Label.MATCH, Label.EXTRA).astype(np.uint8),
        asynchrony_ns=np.where(paired, place_ns[hit_of_note] - FORM.onset_ns, 0),
        hit_score_ns=place_ns,
        segment=np.zeros(len(note), np.int64),
        reference=Reference.PLAYER,
        sd_ms=None,
    )
    return summarise(FORM, Performance.from_array(hits), alignment)


def test_who_stops_and_begins_again_is_told_the_bar() -> None:
    """Stopped in the middle of bar 6, two seconds of silence, again from the beginning: nothing is said of extras."""
    for seed in SEEDS:
        (said,) = advise(joined(seed, 5.5 * BAR_S, 2.0, 0.0))
        assert (said.fault, said.bars) == ("stopped", (6,))
        assert said.text.startswith("You stopped in bar 6 and began again")


def test_bars_that_are_left_out_are_named() -> None:
    for seed in SEEDS:
        (said,) = advise(joined(seed, 5 * BAR_S, 0.0, 6 * BAR_S))
        assert (said.fault, said.bars, said.text[:18]) == ("left_out_bars", (6,), "You left out bar 6")


def test_who_comes_in_again_where_they_stopped_stopped() -> None:
    (said,) = advise(joined(1, 5.5 * BAR_S, 3.0, 5.5 * BAR_S))
    assert (said.fault, said.bars) == ("stopped", (6,))


def test_bars_that_are_played_again_are_named() -> None:
    for seed in SEEDS:
        (said,) = advise(joined(seed, 6 * BAR_S, 0.0, 4 * BAR_S))
        assert (said.fault, said.bars) == ("repeated_bars", (5,))


# --- what a lesson asks -----------------------------------------------------------------------------------------------


def test_a_teacher_names_the_size_or_mutes_the_word() -> None:
    late = Added(shift_ms=15.0 * of(BEAT, Piece.KICK))
    human = Human(sd_ms=8.0, lean_sd_ms=0.0)
    strict = SummaryView(faults=Asked({"late_kick": 12.0}))
    assert advise(human_take(BEAT, 1, late, human)) == ()
    assert [one.fault for one in advise(human_take(BEAT, 1, late, human, view=strict))] == ["late_kick"]
    mute = SummaryView(faults=Asked({"late_kick": None}))
    assert advise(human_take(BEAT, 1, Added(shift_ms=40.0 * of(BEAT, Piece.KICK)), human, view=mute)) == ()


# --- praise and drills ------------------------------------------------------------------------------------------------


def test_praise_is_true() -> None:
    """Every note: said so. One left out: not said."""
    whole = human_take(BEAT, 1)
    assert praise(whole, ()) == f"You played all {len(BEAT)} notes, and nothing else."
    one_less = human_take(BEAT, 1, Added(left_out=np.arange(len(BEAT)) == 40))
    said = praise(one_less, ())
    assert said is not None
    assert "all" not in said
    assert "steady" in said
    assert praise(human_take(BEAT, 1, Added(left_out=np.arange(len(BEAT)) > 5)), ()) is None


def test_the_steadiest_piece_is_named_where_it_is_surely_so_and_on_time() -> None:
    """The hat's strokes lie five times as close as those of kick and snare; not so where all are alike, or it leans."""
    hat, left_out = of(BEAT, Piece.HIHAT), np.arange(len(BEAT)) % 12 == 11
    apart = np.where(hat, 1.2, 6.0)
    said = praise(human_take(BEAT, 1, Added(scatter=apart, left_out=left_out)), ())
    assert said is not None
    assert said.startswith("Your hi-hat is the steadiest: its strokes spread by ")
    assert praise(human_take(BEAT, 1, Added(scatter=3.0, left_out=left_out)), ()) is None
    late = human_take(BEAT, 1, Added(scatter=apart, shift_ms=40.0 * hat, left_out=left_out))
    assert praise(late, ()) is None


def test_a_remark_comes_with_its_drill() -> None:
    """85 % of a little less than 110 bpm, in whole beats as it is said; the kick alone, over the named bars."""
    said = advise(human_take(BEAT, 2, Added(shift_ms=40.0 * of(BEAT, Piece.KICK))))[0]
    assert said.drill.tempo_bpm == pytest.approx(93.0)
    assert said.drill.pieces == ("kick",)
    assert said.drill.bars == (min(said.bars), max(said.bars))


def test_ornaments_of_other_kinds_are_no_flams() -> None:
    """A drag's strokes are 40–70 ms apart (HUMANS): no wide flam."""
    graces = [Note(0, Piece.SNARE, lead_ms=lead, velocity=30, limb=L, ornament=Ornament.DRAG) for lead in (110.0, 55.0)]
    score = Score.from_notes([*graces, Note(0, Piece.SNARE, velocity=90, limb=R)], TempoMap.constant(70), PPQ)
    assert advise(human_take(score.repeated(32), 1)) == ()


def test_the_page_of_faults_has_every_word_and_size() -> None:
    page = (Path(__file__).parents[3] / "docs" / "scoring.md").read_text()
    rows = [line for line in page.splitlines() if line.startswith("| `")]
    for fault, kind in {**FAULTS, **STICK_FAULTS}.items():
        shown = {"late_piece": "late_…", "early_piece": "early_…"}.get(fault, fault)
        (row,) = [line for line in rows if f"`{shown}`" in line]
        assert f"| {kind.group.name.lower()} | {kind.least:g} {kind.unit} |" in row
