"""The drummer's improvised phrases: playable, whole, its own, and the same for the same seed."""

from time import process_time

import numpy as np
import pytest

from station.core.pieces import Limb, Piece
from station.motion.feasibility.playable import impossible
from station.music.score import MAX_LATE_MS
from station.practice.battle.ground import Feel, Ground
from station.practice.battle.improvising.improvise import improvised
from station.practice.battle.opponents.opponent import OPPONENTS
from station.practice.battle.phrase import Phrase, Turn
from station.practice.battle.phrase_as_turn import phrase_as_turn

_GROUNDS = (Ground(96), Ground(140, 4, 4, Feel.TRIPLET, "jazz"), Ground(120, 7, 8), Ground(90, 6, 8), Ground(180, 3, 4))


def _heard(ground: Ground) -> list[Turn]:
    phrase = improvised(OPPONENTS["steady"], ground, 2, [], [], np.random.default_rng(9))
    return [phrase_as_turn(phrase, ground)]


def _phrase(name: str, ground: Ground, seed: int = 1, bars: int = 4) -> Phrase:
    return improvised(OPPONENTS[name], ground, bars, _heard(ground), [], np.random.default_rng(seed))


@pytest.mark.parametrize("name", OPPONENTS)
def test_two_hands_and_two_feet_can_play_every_phrase(name: str) -> None:
    for ground in _GROUNDS:
        phrase = _phrase(name, ground)
        notes = phrase.score.notes
        assert impossible(phrase.score) == []
        assert phrase.bars == 4
        assert len(notes) > 8
        assert (notes["limb"] != Limb.UNKNOWN).all()
        assert np.abs(notes["late_ms"]).max() <= MAX_LATE_MS


@pytest.mark.parametrize("bars", [1, 2, 4, 8])
def test_it_is_as_long_as_is_asked_and_comes_home(bars: int) -> None:
    phrases = [_phrase("pocket", Ground(100), seed, bars) for seed in range(4)]
    assert {phrase.bars for phrase in phrases} == {bars}
    landings = [phrase.landing for phrase in phrases if len(phrase.landing)]
    assert landings
    assert set(landings[0]["piece"].tolist()) == {Piece.CRASH_1, Piece.KICK}
    assert (landings[0]["tick"] == 0).all()


def test_one_seed_is_one_phrase_and_another_another() -> None:
    first, again, other = (_phrase("jazz", Ground(132, feel=Feel.TRIPLET), seed) for seed in (1, 1, 2))
    assert first.score.notes.tobytes() == again.score.notes.tobytes()
    assert first.score.notes.tobytes() != other.score.notes.tobytes()


def test_the_mirror_gives_back_what_it_hears_and_the_machine_does_not() -> None:
    """Shared cells of kick and snare with what was heard, of all that either plays (Jaccard)."""
    ground = Ground(100)
    shares = {}
    for name in ("mirror", "metal"):
        heard = _heard(ground)
        mine = [_spots(_phrase(name, ground, seed)) for seed in range(5)]
        theirs = {(tick % ground.bar_ticks, piece) for tick, piece in _spots_of(heard[0], ground)}
        shares[name] = np.mean([len(spots & theirs) / len(spots | theirs) for spots in mine])
    assert shares["mirror"] > shares["metal"]


def _spots(phrase: Phrase) -> set[tuple[int, int]]:
    bar = phrase.score.tempo_map.bar_start(1)
    rows = phrase.score.notes
    return {(int(r["tick"]) % bar, int(r["piece"])) for r in rows if r["piece"] in (Piece.KICK, Piece.SNARE)}


def _spots_of(turn: Turn, ground: Ground) -> set[tuple[int, int]]:
    cell = ground.beat_ticks // 4
    ticks = ground.tempo_map.ticks_at_ns(turn.played.hits["at_ns"])
    near = np.rint(ticks / cell).astype(int) * cell
    pieces = turn.played.hits["piece"].tolist()
    return {(t, p) for t, p in zip(near.tolist(), pieces, strict=True) if p in (Piece.KICK, Piece.SNARE)}


def test_a_phrase_is_thought_of_within_a_beat() -> None:
    """Some 40 ms of work where nothing else runs; ten times that fails."""
    ground = Ground(96)
    heard = _heard(ground) * 6
    _phrase("pocket", ground)
    begun = process_time()
    improvised(OPPONENTS["pocket"], ground, 4, heard, heard, np.random.default_rng(3))
    assert process_time() - begun < 0.4
