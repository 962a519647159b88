"""Sixteen strokes whose hands the test lays down; right, wrong and unknown are counted by hand."""

import numpy as np
import pytest

from station.core.pieces import Limb
from station.music.performance import Performance
from station.music.score import Score
from station.scoring.align import align
from station.scoring.analysis.findings import find_all
from station.scoring.analysis.summary import Summary, SummaryView, summarise
from station.scoring.report.advice import advise
from station.scoring.report.assessment_document import assessment
from station.scoring.report.praise import praise
from tests.fakes.played import played
from tests.fakes.scores import even_snare

R, L, NOBODY = Limb.RIGHT_HAND, Limb.LEFT_HAND, Limb.UNKNOWN


def summed(written: list[Limb], hands: list[Limb], view: SummaryView | None = None) -> Summary:
    """Snare strokes in bars of four quarters at 240 bpm, written and played by these hands, all on time."""
    score = even_snare(len(written), 250).with_limbs(np.array(written, np.int8))
    take = played(score, score.onset_s, np.arange(len(score)))
    hits = take.hits.copy()
    hits["limb"] = hands
    performance = Performance.from_array(hits)
    return summarise(score, performance, align(score, performance, clocked=True), view)


def test_right_wrong_and_unknown_hands_are_counted_by_bar() -> None:
    """A stroke of the second bar and two of the third are the other hand's; one of the fourth is unknown."""
    hands = [R, L] * 8
    hands[7], hands[9], hands[10], hands[12] = R, R, L, NOBODY
    document = assessment(summed([R, L] * 8, hands))
    assert document["sticking"] == {
        "right": 12,
        "wrong": 3,
        "cannot_tell": 1,
        "wrong_bars": [{"bar": 2, "wrong": 1}, {"bar": 3, "wrong": 2}],
        "played": {"right_hand": 8, "left_hand": 7, "unknown": 1},
    }


def test_without_sensors_nothing_is_said() -> None:
    summary = summed([R, L] * 8, [NOBODY] * 16)
    assert summary.sticking is None
    assert assessment(summary)["sticking"] is None


def test_where_the_lesson_writes_no_hand_any_will_do() -> None:
    free = summed([NOBODY] * 16, [R] * 16)
    asked = summed([R, L] * 8, [R] * 16, SummaryView(asks_hand=np.zeros(16, np.bool_)))
    for summary in (free, asked):
        assert summary.sticking is not None
        assert summary.sticking.told == 0
        assert summary.sticking.played[R] == 16
        assert not any(one.fault == "wrong_sticking" for one in find_all(summary))


def test_a_wrong_sticking_is_advised_with_its_share_and_bars() -> None:
    """Every other paradiddle is played as singles: R L R R L R L L against R L R L R L R L is one and three of four."""
    paradiddle = [R, L, R, R, L, R, L, L]
    summary = summed(paradiddle * 4, (paradiddle + [R, L] * 4) * 2)
    (finding,) = (one for one in find_all(summary) if one.fault == "wrong_sticking")
    assert finding.effect == pytest.approx(100 * 8 / 32)
    assert finding.bars == (2, 3, 7)
    (text,) = (one.text for one in advise(summary) if one.fault == "wrong_sticking")
    assert text == (
        "25 % of your strokes come from the other hand than is written, most in bars 3, 4 and 8: "
        "say the sticking aloud while you play it at 204 bpm."
    )


def test_one_slip_is_no_fault_and_a_clean_sticking_is_praised() -> None:
    hands = [R, L] * 16
    clean = summed(hands, hands)
    slipped = summed(hands, [L, *hands[1:]])
    assert not any(one.fault == "wrong_sticking" for one in find_all(slipped))
    steady_is_said = praise(clean, advise(clean))
    assert steady_is_said is not None
    missing = clean_but_one_missing(hands)
    assert praise(missing, advise(missing)) == (
        "Your sticking is as written: all 31 strokes came from the right hand or the left as asked."
    )


def clean_but_one_missing(hands: list[Limb]) -> Summary:
    """One stroke is left out, and the others scatter by 25 ms, so that neither notes nor time are praised first."""
    score: Score = even_snare(len(hands), 250).with_limbs(np.array(hands, np.int8))
    rows = np.delete(np.arange(len(score)), 5)
    off_s = 0.025 * np.where(rows % 4 < 2, 1.0, -1.0)
    hits = played(score, score.onset_s[rows] + off_s, rows).hits.copy()
    hits["limb"] = np.array(hands)[rows]
    performance = Performance.from_array(hits)
    return summarise(score, performance, align(score, performance, clocked=True))
