"""What a virtual student improvises: what it chooses by its skill, and how it plays that, for battles without a kit.

What it chooses is written from what is published about people, not from what the judge counts:

* Novices explore with few patterns and repeat them; phrases with a form, motifs that grow and a style of one's own come
  with skill (Kratus 1991, 1995: seven levels of improvisation; Pressing 1988: skill is a growing store of chunks).
* Experts plan ahead, take up what was played and recombine it (Norgaard 2011; Berliner 1994), and leave space.
* Dynamics come late: beginners play at one loudness (Dahl 2004 for what accents need; HUMANS, Velocity).
* Beginners lose the one in longer solos, and keep to the snare (teaching practice, our choice of the sizes).

How it plays is `simulation.virtual_student`: its timing, its misses, its uneven hands, and the kit's bytes.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.random import Generator

from station.core.pieces import DRUMS, Dynamic, Piece
from station.devices.mapping.device_map import DeviceMap
from station.devices.mapping.presets import GENERAL_MIDI_PRESET
from station.music.score import Note
from station.practice.battle.ground import Ground
from station.practice.battle.improvising.motif import Turning, motif_of, turned
from station.practice.battle.improvising.played_beats import Beats, beats_of, instrument_of, joined, strokes_of
from station.practice.battle.improvising.strokes_on_grid import GRID, GridStroke, beats_with, grid_strokes
from station.practice.battle.opponents.idiom import ROCK, Idiom
from station.practice.battle.phrase import Turn
from station.practice.battle.repeating.demands import Demand
from station.practice.battle.repeating.made_bars import made_bars
from station.practice.battle.vocabulary.asked_of_limbs import Coordination, Dynamics
from station.practice.battle.vocabulary.limbed import limbed
from station.simulation.student_spec import PLAYERS, StudentSpec
from station.simulation.virtual_student import VirtualPerformance, VirtualStudent

_USUAL_WAIT_S = 0.3
"""Between strokes, to read a spread in ms as a share of it: eighths at 100."""
_SKILL_STREAM, _TURN_STREAM = 101, 102
"""Streams of chance apart from those of the playing (`virtual_student`)."""


@dataclass(frozen=True, slots=True)
class Choosing:
    """How somebody chooses what to play; all but the first three are chances 0–1.

    `patterns` are bars in store, `strokes_per_s` the density, `off_beat` what stands off the beat. `repeats`: a bar is
    the one before it; `develops`: it turns a motif, its own or one that was heard; `fills`: the last bar leads home;
    `lands`: on the next downbeat with crash and kick; `slips`: the turn loses its one from some bar on; `rests`: the
    end of a bar is left to ring; `accents` and `ghosts` are shares of the strokes on drums.
    """

    patterns: int
    strokes_per_s: float
    off_beat: float
    repeats: float
    develops: float
    fills: float
    lands: float
    slips: float
    rests: float
    accents: float
    ghosts: float


_NOVICE = Choosing(2, 3.0, 0.1, 0.7, 0.0, 0.2, 0.2, 0.35, 0.02, 0.0, 0.0)
_EXPERT = Choosing(12, 8.0, 0.6, 0.08, 0.55, 0.95, 0.95, 0.0, 0.25, 0.4, 0.6)
"""The two ends, skill 0 and 1; between them every figure goes straight. An expert's density is that of the Groove MIDI
Dataset's drummers (4.7 strokes a beat at 105), accents and ghosts give the spread of their velocities, 30 in four bars;
the rest is our choice, by the sources above."""


def skill_of(spec: StudentSpec) -> float:
    """0–1 from how evenly the student plays, and how often a stroke fails: 0.1, 0.6 and 0.9 for the named players.

    A spread of 2.5 % of the wait between strokes is a professional's, one of 8 % a novice's (HUMANS, Timing).
    """
    percent = spec.sd_interval_pct if spec.sd_ms is None else spec.sd_ms / 10 / _USUAL_WAIT_S
    pro, novice = PLAYERS["pro"].sd_interval_pct, PLAYERS["beginner"].sd_interval_pct
    uneven = (percent - pro) / (novice - pro)
    missing = spec.miss_pct / PLAYERS["beginner"].miss_pct
    return float(np.clip(0.9 - 0.8 * max(uneven, 0.5 * (uneven + missing)), 0.0, 1.0))


def choosing_at(skill: float) -> Choosing:
    """How somebody of that skill, 0–1, chooses."""
    low, high = (np.array([getattr(one, name) for name in Choosing.__slots__], float) for one in (_NOVICE, _EXPERT))
    values = dict(zip(Choosing.__slots__, (low + (high - low) * skill).tolist(), strict=True))
    return Choosing(**{**values, "patterns": max(1, round(values["patterns"]))})


class VirtualImproviser:
    """A virtual student who improvises turn after turn; it keeps its store of bars, and its timekeeper runs on."""

    def __init__(self, spec: StudentSpec, preset: DeviceMap = GENERAL_MIDI_PRESET) -> None:
        self.spec = spec
        self._choosing = choosing_at(skill_of(spec))
        self._skill = skill_of(spec)
        self._student = VirtualStudent(spec, preset)
        self._store: dict[Ground, tuple[Beats, ...]] = {}
        self._turns = 0

    def improvise(
        self, ground: Ground, bars: int, heard: Sequence[Turn] = (), said: Sequence[Turn] = ()
    ) -> VirtualPerformance:
        """The next turn, after what was `heard` of the other and what it `said` itself, each in order.

        Times are turn time; the landing on the downbeat after the last bar is in it, and in the score a bar more.
        """
        rng = np.random.default_rng([self.spec.seed, _TURN_STREAM, self._turns])
        self._turns += 1
        choosing = self._choosing
        beats = chosen_bars(choosing, self._bars_in_store(ground), bars, heard[-1] if heard else None, rng)
        notes = weighted(strokes_of(beats, ground), choosing, ground, rng)
        if rng.random() < choosing.slips:
            notes = slipped(notes, ground, bars, rng)
        if rng.random() < choosing.lands:
            end = bars * ground.bar_ticks
            notes += [Note(end, Piece.CRASH_1, velocity=108), Note(end, Piece.KICK, velocity=100)]
        return self._student.play(limbed(notes, ground, bars + 1))

    def _bars_in_store(self, ground: Ground) -> tuple[Beats, ...]:
        """The bars that this student knows on such a ground."""
        if ground not in self._store:
            rng = np.random.default_rng([self.spec.seed, _SKILL_STREAM])
            self._store[ground] = stored_bars(self._choosing, self._skill, ground, rng)
        return self._store[ground]


# --- what is in store -------------------------------------------------------------------------------------------------


def stored_bars(choosing: Choosing, skill: float, ground: Ground, rng: Generator) -> tuple[Beats, ...]:
    """The bars that somebody of that skill has learned: grooves first, solos with skill, more on the snare without."""
    idiom = _idiom_at(skill)
    found = []
    for _ in range(choosing.patterns):
        demand = Demand(
            bars=1,
            strokes_per_s=choosing.strokes_per_s * float(rng.uniform(0.75, 1.25)),
            coordination=_coordination(skill, rng),
            dynamics=Dynamics.FLAT,
            off_beat=choosing.off_beat * float(rng.uniform(0.5, 1.4)) if skill > 0 else 0.0,
            difficulty=0.0,
        )
        found.append(
            _as_beats(made_bars(replace(demand, off_beat=min(1.0, demand.off_beat)), ground, idiom, rng), ground)
        )
    return tuple(found)


def _idiom_at(skill: float) -> Idiom:
    """The kit as far as it is used: a novice's hands are on the snare (our choice)."""
    snare = 0.9 - 0.45 * skill
    rest = (1 - snare) / (1 - ROCK.voices[Piece.SNARE])
    voices = {p: snare if p is Piece.SNARE else share * rest for p, share in ROCK.voices.items()}
    return replace(ROCK, voices=voices, groove_share=0.6 - 0.25 * skill)


def _coordination(skill: float, rng: Generator) -> Coordination:
    """Who plays: chance about what the skill allows."""
    least, most = (0, 2) if skill < 0.35 else (1, 2) if skill < 0.75 else (2, 3)
    return Coordination(int(rng.integers(least, most + 1)))


def _as_beats(notes: Sequence[Note], ground: Ground) -> Beats:
    """Made strokes as the beats of one bar."""
    a_bar = ground.beats_a_bar
    strokes = []
    for note in notes:
        beat, rest = divmod(note.tick, ground.beat_ticks)
        length = min(ground.beat_ticks, ground.bar_ticks - beat * ground.beat_ticks)
        instrument = instrument_of(note.piece, note.openness, note.articulation)
        strokes.append(GridStroke(beat * GRID + round(rest * GRID / length), instrument, note.velocity))
    return beats_with(strokes, a_bar, a_bar)


# --- what is chosen ---------------------------------------------------------------------------------------------------


def chosen_bars(choosing: Choosing, store: Sequence[Beats], bars: int, heard: Turn | None, rng: Generator) -> Beats:
    """The bars of a turn: out of the store, repeated, developed, thinned to leave space, the last one leading home."""
    said: list[Beats] = []
    motif = motif_of(beats_of(heard), rng) if heard is not None and rng.random() < choosing.develops else None
    for bar in range(bars):
        if said and rng.random() < choosing.repeats:
            said.append(said[-1])
        elif (said or motif is not None) and rng.random() < choosing.develops:
            source = motif if motif is not None and (not said or rng.random() < 0.5) else said[0]
            said.append(turned(source, _A_TURNING[int(rng.integers(len(_A_TURNING)))], rng))
        else:
            said.append(store[int(rng.integers(len(store)))])
        if bar == bars - 1 and rng.random() < choosing.fills:
            said[-1] = _led_home(said[-1], store, rng)
        elif rng.random() < choosing.rests:
            said[-1] = _left_open(said[-1])
    return joined(said)


_A_TURNING = (Turning.LITERAL, Turning.DISPLACED, Turning.ORCHESTRATED, Turning.ORCHESTRATED, Turning.THINNED)


def _led_home(bar: Beats, store: Sequence[Beats], rng: Generator) -> Beats:
    """The bar whose second half is the busiest in store, on other drums: a fill."""
    busiest = max(store, key=lambda one: int(one.struck.sum()))
    fill = turned(busiest, Turning.ORCHESTRATED, rng)
    half = len(bar) // 2 * GRID
    strokes = [s for s in grid_strokes(bar) if s.at < half] + [s for s in grid_strokes(fill) if s.at >= half]
    return beats_with(strokes, len(bar), bar.beats_a_bar)


def _left_open(bar: Beats) -> Beats:
    """The bar without its last beat but for its first stroke."""
    last = (len(bar) - 1) * GRID
    return beats_with([s for s in grid_strokes(bar) if s.at <= last], len(bar), bar.beats_a_bar)


# --- how loud, and where it goes wrong --------------------------------------------------------------------------------


def weighted(notes: Sequence[Note], choosing: Choosing, ground: Ground, rng: Generator) -> list[Note]:
    """The strokes with the dynamics that the player knows: all alike without skill.

    Who knows where an accent belongs sets it there in every bar: strokes of one place are as loud to within 15–21 of
    velocity, those of a take to within about 30 (HUMANS, Velocity).
    """
    knows = choosing.accents / _EXPERT.accents
    habits: dict[tuple[int, int], float] = {}
    found = []
    for note in sorted(notes, key=lambda note: (note.tick, note.piece)):
        habit = habits.setdefault((note.tick % ground.bar_ticks, note.piece), rng.random())
        by_habit, chance = rng.random() < knows, rng.random()
        found.append(_weighted(note, choosing, ground, habit if by_habit else chance))
    return found


_FLAT, _LOUD, _SOFT, _TAP, _ON_BEAT = 88, 120, 32, 62, 30
"""A novice's one loudness, an accent, a ghost, the strokes between for who has all three, and what feet and cymbals
gain on a beat (HUMANS, Velocity)."""


def _weighted(note: Note, choosing: Choosing, ground: Ground, chance: float) -> Note:
    """The stroke, by a chance 0–1 that accents it where it is low and softens it where it is high."""
    on_beat = note.tick % ground.beat_ticks == 0
    knows = choosing.accents / _EXPERT.accents
    plain = round(_FLAT + (_TAP - _FLAT) * knows)
    if note.piece not in DRUMS:
        return replace(note, velocity=plain + round(_ON_BEAT * knows * on_beat))
    if chance < choosing.accents * (1.4 if on_beat else 0.8):
        return replace(note, velocity=_LOUD, dynamic=Dynamic.ACCENT)
    if note.piece is Piece.SNARE and not on_beat and chance > 1 - choosing.ghosts:
        return replace(note, velocity=_SOFT, dynamic=Dynamic.GHOST)
    return replace(note, velocity=plain)


def slipped(notes: Sequence[Note], ground: Ground, bars: int, rng: Generator) -> list[Note]:
    """From a bar on all comes half a beat early or late, as when somebody has lost the one; what falls out is lost."""
    from_tick = int(rng.integers(1, max(2, bars))) * ground.bar_ticks if bars > 1 else ground.bar_ticks // 2
    by = int(rng.choice((-1, 1))) * ground.beat_ticks // 2
    moved = [replace(note, tick=note.tick + by) if note.tick >= from_tick else note for note in notes]
    return [note for note in moved if note.tick < bars * ground.bar_ticks]
