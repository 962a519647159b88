"""One phrase's motion runs into the next one's: nothing jumps, every stroke is in its place, late plans come softly."""

from concurrent.futures import Future

import numpy as np
import pytest

from station.core.pieces import Limb, Piece
from station.core.units import NS_PER_S
from station.motion.drummer import Drummer
from station.motion.kinematics import frame
from station.motion.kinematics.figure import Joint
from station.scenes.battle import motion_chain
from station.scenes.battle.motion_chain import TAKES_OVER_NS, Body, MotionChain
from tests.unit.scenes.battle.battles_on_stage import BAR_NS, GROUND, phrase, speeds

_JOINTS = (Joint.RIGHT_ELBOW, Joint.LEFT_WRIST, Joint.RIGHT_KNEE, Joint.RIGHT_TOE, Joint.CROWN)
HZ = 240
PHRASES = (phrase(2), phrase(1, (Piece.TOM_1, Piece.FLOOR_TOM_1)), phrase(2, (Piece.FLOOR_TOM_1, Piece.SNARE)))
BARS = (0, 2, 3)
TIMES = np.arange(-0.8, 5.6 * BAR_NS / NS_PER_S, 1 / HZ)


@pytest.fixture(scope="module")
def rows() -> np.ndarray:
    """The poses of the whole, (n, fields)."""
    chain = MotionChain(GROUND, Body(), waits=True)
    for bar, said in zip(BARS, PHRASES, strict=True):
        chain.add(bar, said.bars, said.with_landing.notes)
    return np.array([chain.pose(round(at_s * NS_PER_S)).row for at_s in TIMES])


def hand_over() -> np.ndarray:
    """Which of the times lie in the time before a phrase begins in which one motion gives way to another."""
    begins = [bar * BAR_NS / NS_PER_S for bar in BARS]
    long = TAKES_OVER_NS / NS_PER_S
    return np.asarray(np.any([(begin - long <= TIMES) & (begin + 0.05 >= TIMES) for begin in begins], axis=0))


@pytest.mark.parametrize(
    "point",
    [frame.TIP.start, frame.TIP.start + 3, *(3 * joint for joint in _JOINTS)],
)
def test_nothing_moves_or_turns_faster_at_hand_over_than_within_phrases(rows: np.ndarray, point: int) -> None:
    speed, acceleration = speeds(rows[:, point : point + 3], HZ)
    over = hand_over()
    assert speed[over[1:]].max() <= 1.05 * speed[~over[1:]].max() + 0.02
    assert acceleration[over[2:]].max() <= 1.1 * acceleration[~over[2:]].max() + 2.0


def test_limbs_and_sticks_keep_their_lengths(rows: np.ndarray) -> None:
    joints = rows[:, frame.JOINTS].reshape(-1, 21, 3)
    for one, other in ((Joint.RIGHT_SHOULDER, Joint.RIGHT_ELBOW), (Joint.LEFT_ELBOW, Joint.LEFT_WRIST)):
        assert np.ptp(np.linalg.norm(joints[:, one] - joints[:, other], axis=1)) < 1e-6
    sticks = np.linalg.norm(rows[:, frame.TIP.start : frame.TIP.start + 3] - rows[:, frame.BUTT.start : 66], axis=1)
    assert np.ptp(sticks) < 1e-6


def test_every_first_stroke_is_on_its_piece_and_was_prepared() -> None:
    """The landing of a phrase falls on the downbeat of the next one, whose motion has taken over by then."""
    chain = MotionChain(GROUND, Body(), waits=True)
    for bar, said in zip(BARS, PHRASES, strict=True):
        chain.add(bar, said.bars, said.with_landing.notes)
    crash = chain.kit.pieces[Piece.CRASH_1]
    for bar in (2, 3):
        before = chain.pose(bar * BAR_NS - 120_000_000).tip_m
        at = chain.pose(bar * BAR_NS).tip_m
        off = (at - crash.centre) @ crash.normal
        hand = int(np.argmin(np.abs(off)))
        assert abs(off[hand]) < 0.02
        assert (before[hand] - at[hand])[2] > 0.03, "raised before it falls"


def test_a_link_that_is_late_takes_over_as_softly(monkeypatch: pytest.MonkeyPatch) -> None:
    """The plan of a phrase is there only a quarter of a second after its downbeat."""
    waiting: list[tuple[Future[Drummer], object]] = []

    class Slow:
        def submit(self, make: object) -> Future[Drummer]:
            coming: Future[Drummer] = Future()
            waiting.append((coming, make))
            return coming

    monkeypatch.setattr(motion_chain, "AHEAD", Slow())
    chain = MotionChain(GROUND, Body())
    chain.add(0, 1, PHRASES[0].score.bars(0, 0).notes)
    rows = []
    for at_s in (times := np.arange(-0.8, 1.4, 1 / HZ)):
        if at_s >= 0.25 and waiting:
            coming, make = waiting.pop()
            coming.set_result(make())  # type: ignore[operator]
        rows.append(chain.pose(round(at_s * NS_PER_S)).row)
    tips = np.array(rows)[:, frame.TIP]
    speed = max(speeds(tips[:, k : k + 3], HZ)[0].max() for k in (0, 3))
    assert speed < 12.0, "no faster than a loud stroke (HUMANS: tips at 5 to 12 m/s)"
    assert np.ptp(tips[times < 0.25], axis=0).max() < 0.1, "at rest until then"


def test_what_is_not_played_after_all_is_cut() -> None:
    chain = MotionChain(GROUND, Body(), waits=True)
    chain.add(0, 1, PHRASES[0].score.bars(0, 0).notes)
    chain.add(1, 2, PHRASES[0].with_landing.notes)
    chain.cut(1)
    still = [chain.pose(round(at_s * NS_PER_S)).tip_m for at_s in np.arange(5.5, 6.0, 0.05)]
    assert np.ptp(np.array(still), axis=0).max() < 0.03


def test_limbs_of_the_bar_before_are_kept() -> None:
    """A stroke that says no limb is made by the same limb in both links that hold it."""
    chain = MotionChain(GROUND, Body(), waits=True)
    notes = PHRASES[0].score.notes.copy()
    notes["limb"] = Limb.UNKNOWN
    chain.add(0, 2, notes)
    tips = [chain.pose(round(at_s * NS_PER_S)).tip_m for at_s in np.arange(1.0, 4.0, 1 / HZ)]
    assert max(speeds(np.array(tips)[:, side], HZ)[0].max() for side in (0, 1)) < 15.0
