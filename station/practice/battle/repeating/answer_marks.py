"""How well a phrase was repeated: the station's one alignment, and its one answer to which notes are right.

    accuracy = right / (known notes + extras)

the share of notes right among all that was asked or struck besides (the index of Jaccard 1901). So a note that is
missed or played on another piece costs 1 / notes, and a stroke too many 1 / (notes + 1): a fifth in a phrase of four
notes, one in twenty of nineteen. A stroke so late that it answers no note is both. Who hammers every pad on every 16th
of a bar of 13 notes has 115 extras, and 10 %. A note is known unless nobody could hear whether it was played. A
lesson's score takes the square of its precision (`scoring.analysis.points`), for it is of many bars; a phrase of four
notes would lose 36 points by a stray stroke.

A battle has one time: whoever answers a beat late, or begins again, has answered late, so that each stroke is measured
where it was played. The phrase's landing on the next downbeat may be played and need not be: it counts neither as a
note nor as an extra, nor does any stroke after the bars' end.

A lean is told of the right notes alone, and where the report of a session would tell one: where there are as many as an
interval asks for (`technique.estimates`), and it leaves out 0.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from station.core.units import NS_PER_MS
from station.music.judgement import Label
from station.music.performance import Performance
from station.practice.battle.phrase import Phrase, Turn
from station.practice.battle.phrase_as_turn import phrase_as_turn
from station.scoring.align import align
from station.scoring.analysis.technique.estimates import figure
from station.scoring.matching.alignment import Alignment
from station.scoring.matching.hit_windows import Windows
from station.scoring.matching.right import right_notes
from station.scoring.matching.unheard import Span, notes_within, with_unknown

ACCURACY_WORDS = "notes right of those asked and those too many"
"""What accuracy is, in a line."""
_ROUNDING = 1e-9
"""100 · 0.29 is a little less than 29."""
_UNASKED = (Label.EXTRA, Label.PLAYED_AGAIN)


@dataclass(frozen=True, slots=True)
class AnswerMarks:
    """An answer's counts.

    `accuracy` 0–1 is None where nothing is known; `mean_ms` is the lean of the right notes, negative is
    early, None where they do not tell one.
    """

    notes: int
    known: int
    right: int
    answered: int
    wrong_pieces: int
    extras: int
    mean_ms: float | None

    @property
    def accuracy(self) -> float | None:
        """As the module's head says."""
        if not self.known:
            return None
        return self.right / (self.known + self.extras)

    @property
    def percent(self) -> int | None:
        """It in percent, as it is told everywhere: rounded down, so that what is lost never reads as the target."""
        return None if self.accuracy is None else percent_of(self.accuracy)

    @property
    def points(self) -> float | None:
        """0–100, None where nothing is known."""
        return None if self.accuracy is None else 100.0 * self.accuracy

    def is_won(self, target: float) -> bool | None:
        """Whether the target was reached; None where nothing is known."""
        return None if self.accuracy is None else self.accuracy >= target


def percent_of(accuracy: float) -> int:
    """An accuracy, or a mean of some, in whole percent, rounded down."""
    return int(100.0 * accuracy + _ROUNDING)


def answer_marks(phrase: Phrase, turn: Turn, windows: Windows, unheard: Sequence[Span] = ()) -> AnswerMarks:
    """How well `turn` repeats `phrase`; `unheard` in turn time are the spans in which no stroke could be heard."""
    score = phrase.with_landing
    alignment = _in_place(align(score, turn.played, clocked=True), score.onset_ns, turn.played)
    alignment = with_unknown(alignment, notes_within(score, unheard))
    asked = score.notes["tick"] < phrase.score.end_tick
    label = alignment.note_label[asked]
    right = right_notes(score, alignment, windows) & asked
    in_bars = turn.played.hits["at_ns"] < turn.length_ns
    return AnswerMarks(
        notes=int(asked.sum()),
        known=int(np.count_nonzero(label != Label.UNKNOWN)),
        right=int(np.count_nonzero(right)),
        answered=int(np.count_nonzero(label == Label.MATCH)),
        wrong_pieces=int(np.count_nonzero(label == Label.WRONG_PIECE)),
        extras=int(np.count_nonzero(np.isin(alignment.hit_label, _UNASKED) & in_bars)),
        mean_ms=_lean_ms(alignment.asynchrony_ns, score.notes["tick"], right & ~score.is_grace),
    )


def answer_well_ended(phrase: Phrase, turn: Turn, windows: Windows, until_ns: int) -> AnswerMarks:
    """The same, had all from `until_ns` of the turn on been played as written: at best it can still become this."""
    written = phrase_as_turn(phrase, turn.ground).played.hits
    before, after = turn.played.hits["at_ns"] < until_ns, written["at_ns"] >= until_ns
    played = Performance.from_array(np.concatenate([turn.played.hits[before], written[after]]))
    return answer_marks(phrase, replace(turn, played=played), windows)


def _lean_ms(off_ns: NDArray[np.int64], tick: NDArray[np.int64], told: NDArray[np.bool_]) -> float | None:
    """The mean of the notes (n,) that are `told`; None where they are too few, or it may be chance."""
    lean = figure(off_ns[told] / NS_PER_MS, tick[told])
    return lean.mean if lean.ci is not None and lean.ci[0] * lean.ci[1] > 0 else None


def _in_place(alignment: Alignment, onset_ns: NDArray[np.int64], played: Performance) -> Alignment:
    """The alignment with each stroke measured where it was played, wherever it was found to belong."""
    paired = alignment.hit_of_note >= 0
    off_ns = np.zeros(len(onset_ns), np.int64)
    off_ns[paired] = played.hits["at_ns"][alignment.hit_of_note[paired]] - onset_ns[paired]
    return replace(alignment, asynchrony_ns=off_ns)
