"""A groove that keeps how it was played is demonstrated, practised and judged by its own onsets, not by its cells."""

from random import Random

import numpy as np

from station.core.events import Hit
from station.core.pieces import Limb, Zone
from station.drills.reading.lesson_file import parse_lesson
from station.motion.audit import audit
from station.motion.drummer import Drummer
from station.motion.kit.kit import load_kit
from station.motion.sticking.limbs import assign_limbs
from station.music.judgement import Label
from station.music.performance import Performance
from station.music.score import MAX_LATE_MS, Score
from station.scoring.align import align

_RANDOM = Random(4)


def _score(hihat: str, snare: str, kick: str, most_ms: float, tempo_bpm: int = 100) -> Score:
    """A groove with timing drawn evenly up to `most_ms` either way, its first strokes 20 ms early."""
    lines = {"hihat": hihat, "snare": snare, "kick": kick}
    text = f'title = "T"\ntempo_bpm = {tempo_bpm}\n[grid]\n'
    for name, line in lines.items():
        late = [round(_RANDOM.uniform(-most_ms, most_ms), 1) for _ in line.replace("-", "").replace("|", "")]
        late[0] = -20 if line[0] != "-" else late[0]
        text += f'{name} = "{line}"\ntiming.{name} = {late}\n'
    lesson = parse_lesson(text, "t.toml", "t").lesson
    assert lesson is not None
    return lesson.score


GROOVE = _score("x-x-x-x-|x-x-x-x-", "--o---o-|--o---oo", "o---o---|o--oo---", 25)


def _played(score: Score) -> list[Hit]:
    return [Hit(ns, n.piece, Zone(n.zone), n.velocity) for n, ns in zip(score, score.onset_ns.tolist(), strict=True)]


def test_whoever_plays_as_it_was_played_is_never_off() -> None:
    loop = GROOVE.repeated(3)
    assert int(loop.onset_ns.min()) == -20_000_000  # before the first beat of the first pass
    for clocked in (True, False):
        found = align(loop, Performance.from_hits(_played(loop)), clocked=clocked)
        assert found.count(Label.MATCH) == len(loop)
        assert np.abs(found.asynchrony_ns[~np.isnan(found.asynchrony_ns)]).max() < 1e5  # a tenth of a millisecond


def test_whoever_plays_on_the_cells_is_off_by_the_timing() -> None:
    loop = GROOVE.repeated(3)
    found = align(loop, Performance.from_hits(_played(loop.on_the_grid)), clocked=True)
    assert found.count(Label.MATCH) == len(loop)
    assert np.allclose(found.asynchrony_ns / 1e6, -loop.notes["late_ms"], atol=1e-3)


def test_hands_are_the_same_whatever_the_timing() -> None:
    kit = load_kit("four_piece")
    timed, plain = (assign_limbs(score, kit).limbs for score in (GROOVE, GROOVE.on_the_grid))
    assert timed.tolist() == plain.tolist()
    assert Limb.UNKNOWN not in timed


def test_the_drummer_strikes_when_it_sounds() -> None:
    found = audit(Drummer(GROOVE))
    assert found.strike_m.value <= 1e-6, found.strike_m


def test_strokes_that_change_places_harm_nobody() -> None:
    """Sixteenths of one hand at 160, 94 ms apart, each up to 60 ms from its cell: some come before their neighbour."""
    quick = _score("xxxxxxxxxxxxxxxx", "----o-------o---", "o-------o-------", MAX_LATE_MS, tempo_bpm=160)
    assert (np.diff(quick.onset_ns[quick.notes["piece"] == 2]) < 0).any()
    assert np.isfinite(Drummer(quick).rows(np.linspace(-0.5, 2.0, 200))).all()
    found = align(quick, Performance.from_hits(_played(quick)), clocked=True)
    assert found.count(Label.MATCH) >= len(quick) - 2
