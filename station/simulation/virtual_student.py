"""A student made of numbers, who plays a score as people do and knows what it did.

`play(score, spec)` returns the hits, the same as MIDI bytes for the engine's decoder, and the truth: which hit answers
which note. Times are score time in ns from tick 0 of the score; an early first stroke is before 0. What is written is
on the click, so asynchronies are against it: played − written, **negative is early**.

`student_spec` says what the student is like, `student_timing` and `student_onsets` when it strikes, `student_faults`
its habits, `student_slips` what it gets wrong, `student_strokes` how it strikes, `student_midi` how that is sent.

One seed is one playing. Each cause draws from a stream of its own, so that a spec with more misses has the same timing.
"""

import copy
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from station.core.units import NS_PER_MS
from station.devices.mapping.device_map import DeviceMap
from station.devices.mapping.presets import GENERAL_MIDI_PRESET
from station.music.judgement import Label, Matching
from station.music.performance import Performance
from station.music.score import Score
from station.scoring.report.assessment_document import Json
from station.simulation.student_faults import habits_of
from station.simulation.student_form import Form, form_of
from station.simulation.student_midi import TimedBytes, as_sent, midi_stream
from station.simulation.student_onsets import OnsetPlayer, Streams
from station.simulation.student_reading import StudentReading
from station.simulation.student_slips import Slipper, Slips
from station.simulation.student_spec import FAULTS, StudentSpec
from station.simulation.student_strokes import PlayedStrokes, bounces_of, chokes_of

NOBODY = -1
"""The partner of a note or hit that has none."""
_STREAMS = 9


@dataclass(frozen=True, eq=False)
class VirtualPerformance:
    """What a virtual student played, and the truth about it.

    `performance` the hits as the kit reports them, each with the limb that played it; `truth` which hit answers which
    note; `preset` the kit; `habit_strokes` how many strokes each planted fault concerns.
    """

    score: Score
    spec: StudentSpec
    performance: Performance
    truth: Matching
    preset: DeviceMap
    habit_strokes: dict[str, int]

    @cached_property
    def midi(self) -> list[TimedBytes]:
        """The same hits as the kit's MIDI bytes, with their times in ns, in order."""
        return midi_stream(self.performance, self.preset)

    def asynchrony_ms(self) -> NDArray[np.float64]:
        """Asynchronies of the main strokes that were rightly played, in the score's order; no grace strokes."""
        rows = (self.truth.note_label == Label.MATCH) & ~self.score.is_grace
        played_ns = self.performance.hits["at_ns"][self.truth.hit_of_note[rows]]
        asynchrony: NDArray[np.float64] = (played_ns - self.score.onset_ns[rows]) / NS_PER_MS
        return asynchrony

    def truth_document(self) -> dict[str, Json]:
        """Counts and timing under the keys of the `practice` document, and what was planted; None is no data."""
        asynchrony = self.asynchrony_ms()
        return {
            "spec": self.spec.text(),
            "counts": {
                "notes": len(self.score),
                "hits": len(self.performance),
                "matched": self.truth.count(Label.MATCH),
                "misses": self.truth.count(Label.MISS),
                "extras": self.truth.count(Label.EXTRA),
                "wrong_piece": self.truth.count(Label.WRONG_PIECE),
                "ignored": self.truth.count(Label.IGNORED),
                "played_again": self.truth.count(Label.PLAYED_AGAIN),
                "unknown": self.truth.count(Label.UNKNOWN),
            },
            "timing": {
                "mean_signed_asynchrony_ms": float(asynchrony.mean()) if len(asynchrony) else None,
                "sd_asynchrony_ms": float(asynchrony.std(ddof=1)) if len(asynchrony) > 1 else None,
            },
            "faults": [
                {
                    "fault": fault.name,
                    "size": fault.size,
                    "unit": FAULTS[fault.name].unit,
                    "strokes": self.habit_strokes[fault.name],
                }
                for fault in self.spec.faults
            ],
        }


class VirtualStudent:
    """A student who remembers: its timekeeper and the sway of its tempo go on from one score to the next."""

    def __init__(self, spec: StudentSpec, preset: DeviceMap = GENERAL_MIDI_PRESET) -> None:
        self.spec = spec
        self.preset = preset
        rng = [np.random.default_rng([spec.seed, stream]) for stream in range(_STREAMS)]
        self._onsets = OnsetPlayer(spec.drift_pct, Streams(*rng[:5]))
        self._slipper = Slipper(rng[5], rng[6])
        self._strokes = PlayedStrokes(rng[7], rng[8])

    def twin(self) -> "VirtualStudent":
        """A student who would play the same from now on."""
        twin = copy.copy(self)
        twin._onsets, twin._slipper, twin._strokes = copy.deepcopy((self._onsets, self._slipper, self._strokes))
        return twin

    def play(self, score: Score, form: Form | None = None) -> VirtualPerformance:
        """`score` played after what was played before, in the form that the specification says unless another is given.

        Raises `BadInput` where the kit lacks one of its pieces.
        """
        reading = StudentReading.of(score)
        form = form_of(self.spec, score) if form is None else form
        habits = habits_of(score, reading.limbs, self.spec.faults)
        slips = self._slipper.slip(reading, form)
        timing = self._onsets.time(reading, form)
        notes = self._strokes.of_notes(reading, form, habits, slips)
        notes["at_ns"] = self._onsets.onsets_ns(reading, timing, habits, slips)
        extras = self._strokes.of_extras(reading, form, slips)
        extras["at_ns"] = self._onsets.extra_onsets_ns(reading, timing, slips.extra_tick)
        self._onsets.finish(reading)

        played = np.flatnonzero(slips.label != Label.MISS)
        bounces = bounces_of(score, habits, slips, notes)
        hits = np.concatenate([notes[played], extras, bounces])
        order = np.argsort(hits["at_ns"], kind="stable")
        chokes = chokes_of(score, habits, slips, notes["at_ns"])
        sent = as_sent(Performance.from_array(hits[order], chokes), self.preset)
        return VirtualPerformance(
            score=score,
            spec=self.spec,
            performance=sent,
            truth=_truth(slips, played, len(bounces), order),
            preset=self.preset,
            habit_strokes=habits.strokes,
        )


def joined(parts: Sequence[VirtualPerformance], score: Score, performance: Performance) -> VirtualPerformance:
    """What one student played part by part, as one playing of `score`, the parts in a row; `performance` is all hits.

    No hit of a part may lie beyond one of the next, which silences between the parts see to.
    """
    notes = np.cumsum([0] + [len(part.score) for part in parts]).tolist()
    hits = np.cumsum([0] + [len(part.performance) for part in parts]).tolist()
    moved = [
        (_moved(part.truth.hit_of_note, hit), _moved(part.truth.note_of_hit, note))
        for part, note, hit in zip(parts, notes, hits, strict=False)
    ]
    truth = Matching(
        np.concatenate([hit_of_note for hit_of_note, _ in moved]),
        np.concatenate([note_of_hit for _, note_of_hit in moved]),
        np.concatenate([part.truth.note_label for part in parts]),
        np.concatenate([part.truth.hit_label for part in parts]),
    )
    strokes: Counter[str] = Counter()
    for part in parts:
        strokes.update(part.habit_strokes)
    return replace(parts[0], score=score, performance=performance, truth=truth, habit_strokes=dict(strokes))


def _moved(partner: NDArray[np.int64], by: int) -> NDArray[np.int64]:
    return np.where(partner == NOBODY, NOBODY, partner + by)


def play(score: Score, spec: StudentSpec, preset: DeviceMap = GENERAL_MIDI_PRESET) -> VirtualPerformance:
    """`score` played once by a new student; raises `BadInput` where the kit lacks one of its pieces."""
    return VirtualStudent(spec, preset).play(score)


def _truth(slips: Slips, played: NDArray[np.int64], bounces: int, order: NDArray[np.int64]) -> Matching:
    """The matching of rows and hits: hit `j` is `order[j]` in the list of rows `played`, extras and bounces."""
    others = [Label.EXTRA] * len(slips.extra_tick) + [Label.IGNORED] * bounces
    note_of_hit = np.concatenate([played, np.full(len(others), NOBODY)])[order]
    hit_label = np.concatenate([slips.label[played], np.array(others, np.uint8)])[order].astype(np.uint8)
    hit_of_note = np.full(len(slips.label), NOBODY, np.int64)
    answers = np.flatnonzero(note_of_hit != NOBODY)
    hit_of_note[note_of_hit[answers]] = answers
    return Matching(hit_of_note, note_of_hit, slips.label, hit_label)
