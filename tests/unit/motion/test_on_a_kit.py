"""What is beyond a human, worked by hand; and a right-handed lesson read by a left-handed player."""

from station.core.pieces import Limb, Piece, Zone
from station.core.units import PPQ
from station.motion.feasibility.on_a_kit import infeasible_demands
from station.motion.kit.kit import load_kit
from station.motion.sticking.limbs import as_led, assign_limbs
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from tests.unit.motion.patterns import ROCK, score_of

KIT = load_kit()
HAND = Limb.RIGHT_HAND


def said(score: Score) -> tuple[str, ...]:
    return tuple(b.text for b in infeasible_demands(score, KIT, score.notes["limb"]))


def repeated(count: int, each_ticks: int, bpm: float) -> Score:
    notes = [Note(4 * PPQ + i * each_ticks, Piece.SNARE, limb=HAND) for i in range(count)]
    return Score.from_notes(notes, TempoMap.constant(bpm))


def test_fourteen_strokes_a_second_are_named_with_their_bar() -> None:
    """Eighths at 420 bpm are 14 a second; a champion's hand does 10 (Fujii 2009)."""
    assert said(repeated(6, PPQ // 2, 420)) == ("bar 2 needs 14 strokes a second of one hand",)


def test_a_champions_rate_and_a_double_are_human() -> None:
    assert said(repeated(8, PPQ // 2, 300)) == ()  # 10 a second
    assert said(repeated(2, PPQ // 2, 500)) == ()  # 60 ms: a rebound


def test_a_long_run_just_over_a_champions_rate_is_named_a_short_one_not() -> None:
    """Eighths at 345 bpm are 11.5 a second: within a short burst's scatter, not for a second on end."""
    assert said(repeated(5, PPQ // 2, 345)) == ()
    assert said(repeated(6, PPQ // 2, 345)) == ("bar 2 needs 12 strokes a second of one hand",)
    assert said(repeated(6, PPQ // 2, 312)) == ()  # 10.4 a second


def bouncing(*velocities: int, each_ms: float = 60.0) -> Score:
    """One hand's strokes on the snare, so long apart, as loud as said."""
    ticks = [4 * PPQ + round(i * each_ms / 600 * PPQ) for i in range(len(velocities))]
    notes = [Note(t, Piece.SNARE, velocity=v, limb=HAND) for t, v in zip(ticks, velocities, strict=True)]
    return Score.from_notes(notes, TempoMap.constant(100))


def test_a_stick_that_bounces_on_is_human() -> None:
    """A recorded drummer's 127, 33, 8 at some 80 ms: a blow, its rebound (HUMANS: 50-90 ms), and what is left of it."""
    assert said(bouncing(127, 33, 8)) == ()
    assert said(bouncing(127, 60, 33, 20, 8)) == ()


def test_what_does_not_die_away_is_no_bounce() -> None:
    """60 ms apart is 17 a second; champions do 10. A blow just after a bounce is one too soon as well."""
    for velocities in (
        (33, 80, 127),
        (80, 80, 80),
        (127, 33, 8, 90),
        (90, 60, 90, 60, 90, 60),
        tuple(range(90, 80, -1)),
    ):
        assert said(bouncing(*velocities)) == ("bar 2 needs 17 strokes a second of one hand",), velocities


def test_no_foot_bounces() -> None:
    notes = [Note(4 * PPQ + i * PPQ // 10, Piece.KICK, velocity=v) for i, v in enumerate((127, 33, 8))]
    score = Score.from_notes(notes, TempoMap.constant(100))
    assert [b.text for b in assign_limbs(score, KIT).infeasible] == ["bar 2 needs 17 strokes a second of one foot"]


def test_a_hand_in_two_far_places_is_named_with_the_way_and_the_time() -> None:
    """From the snare to the floor tom it is about 60 cm; 50 ms leave 12 m/s, a boxer's fist does 9."""
    tick = 4 * PPQ
    for gap, words in ((0, "in two places at once"), (PPQ // 12, "in 50 ms")):
        notes = [Note(tick, Piece.SNARE, limb=HAND), Note(tick + gap, Piece.FLOOR_TOM_1, limb=HAND)]
        (text,) = said(Score.from_notes(notes, TempoMap.constant(100)))
        assert text.startswith("bar 2 needs one hand to ")
        assert words in text


def test_rebound_and_whip_have_their_share_of_the_time_for_a_way() -> None:
    """Ride to snare, 78 cm: a fist that starts and ends at rest, twice its mean speed at its peak, takes 0.16 s.

    A recording that two hands played asks 176 ms of one; nobody strikes and is under way at once.
    """
    tick = 4 * PPQ
    for gap_ms, named in ((176, True), (240, False)):
        far = tick + round(gap_ms / 600 * PPQ)
        notes = [Note(tick, Piece.RIDE, Zone.BOW, limb=HAND), Note(far, Piece.SNARE, limb=HAND)]
        assert bool(said(Score.from_notes(notes, TempoMap.constant(100)))) is named


def test_the_span_holds_the_strokes_that_ask_it() -> None:
    score = repeated(6, PPQ // 2, 420)
    (found,) = infeasible_demands(score, KIT, score.notes["limb"])
    assert (found.start_s, found.end_s) == (score.onset_s[0], score.onset_s[-1])
    assert (found.bar, found.limb) == (1, HAND)


def test_a_groove_is_human() -> None:
    score = score_of(ROCK)
    assert assign_limbs(score, KIT).infeasible == ()


def test_a_left_handed_player_reads_r_as_the_leading_hand() -> None:
    notes = [
        Note(i * PPQ, Piece.SNARE, Zone.HEAD, limb=limb)
        for i, limb in enumerate((Limb.RIGHT_HAND, Limb.LEFT_HAND, Limb.RIGHT_HAND, Limb.UNKNOWN))
    ]
    notes += [Note(4 * PPQ, Piece.KICK, limb=Limb.RIGHT_FOOT)]
    score = Score.from_notes(notes, TempoMap.constant(100))
    led = as_led(score, load_kit("left_handed"))
    assert led.notes["limb"].tolist() == [1, 0, 1, -1, 3]
    assert as_led(score, KIT) is score
