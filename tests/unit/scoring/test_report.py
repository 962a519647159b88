"""Summary, JSON document and CSV of one small performance that is counted by hand."""

import csv
import io
import json
from pathlib import Path

import pytest

from station.core.events import Hit
from station.core.pieces import Limb, Piece, Zone
from station.core.units import NS_PER_MS
from station.music.performance import Performance
from station.music.score import Score
from station.scoring.align import align
from station.scoring.analysis.summary import Summary, SummaryView, WrongPiece, summarise
from station.scoring.report.assessment_document import Json, assessment
from station.scoring.report.pairs_table import COLUMNS, pairs_csv, write_pairs
from tests.fakes.scores import flams, rock_beat


def hit(at_ms: float, piece: Piece, velocity: int = 80, midi_note: int = 0) -> Hit:
    return Hit(
        round(at_ms * NS_PER_MS), piece, Zone.BOW if piece is Piece.HIHAT else Zone.HEAD, velocity, midi_note=midi_note
    )


def small() -> tuple[Score, Performance]:
    """A bar of rock, 13 notes at 120 bpm: kicks at 0 and 1000, snares 500 and 1500, ghost 875, hats each 250.

    Played: all hats 4 ms late, kick at 0 10 early, the one at 1000 missing; snare at 500 hit on the tom; snare at 1500
    right; ghost right; a crash at 1125 nobody wrote; a chick at 1500 that nobody counts.
    """
    hats = [hit(250 * i + 4, Piece.HIHAT, 80) for i in range(8)]
    drums = [hit(-10, Piece.KICK, 90), hit(500, Piece.TOM_1, 100), hit(1500, Piece.SNARE, 110, midi_note=38)]
    more = [hit(875, Piece.SNARE, 32), hit(1125, Piece.CRASH_1, 100), hit(1500, Piece.HIHAT_PEDAL, 60)]
    return rock_beat(1), Performance.from_hits(hats + drums + more)


def summed(score: Score, performance: Performance, view: SummaryView | None = None) -> Summary:
    return summarise(score, performance, align(score, performance, clocked=True), view)


def test_counts_by_hand() -> None:
    counts = summed(*small()).counts
    assert (counts.notes, counts.hits) == (13, 14)
    assert (counts.matched, counts.misses, counts.wrong_piece, counts.extras, counts.ignored) == (11, 1, 1, 1, 1)


def test_timing_by_hand() -> None:
    """Eight hats at +4, kick −10, snare 0, ghost 0: mean 22/11."""
    summary = summed(*small())
    assert summary.timing.mean_ms == pytest.approx(2.0)
    assert summary.by_piece[Piece.HIHAT].timing.mean_ms == pytest.approx(4.0)
    assert summary.by_piece[Piece.HIHAT].timing.sd_ms == pytest.approx(0.0)
    assert summary.by_piece[Piece.KICK].timing.mean_ms == pytest.approx(-10.0)
    assert summary.by_piece[Piece.KICK].timing.sd_ms is None


def test_pieces_by_hand() -> None:
    table = summed(*small()).by_piece
    snare, crash, tom = table[Piece.SNARE], table[Piece.CRASH_1], table[Piece.TOM_1]
    assert (snare.notes, snare.matched, snare.wrong_piece, snare.extras) == (3, 2, 1, 0)
    assert (crash.notes, crash.extras, crash.velocity_error) == (0, 1, None)
    assert (tom.notes, tom.extras) == (0, 0)
    assert summed(*small()).wrong_pieces == (WrongPiece(Piece.SNARE, Piece.TOM_1, 1),)


def test_subdivisions_by_hand() -> None:
    """Four quarters with 4 + 2 + 2 notes, four eighths, one 16th (the ghost)."""
    table = summed(*small()).by_subdivision
    assert {name: group.notes for name, group in table.items()} == {"quarter": 8, "eighth": 4, "sixteenth": 1}


def test_grace_strokes_count_but_have_no_timing() -> None:
    score = flams(1)
    hits = [
        hit(at / NS_PER_MS + (20 if grace else 0), Piece.SNARE)
        for at, grace in zip(score.onset_ns, score.is_grace, strict=True)
    ]
    summary = summed(score, Performance.from_hits(hits))
    assert (summary.counts.matched, summary.timing.count, summary.timing.mean_ms) == (8, 4, 0.0)
    assert summary.by_limb[Limb.LEFT_HAND].timing.mean_ms is None


def test_bars_of_a_loop_fold_onto_the_lessons_bars() -> None:
    score = rock_beat(4)
    performance = Performance.from_hits(
        [hit(at / NS_PER_MS, note.piece) for at, note in zip(score.onset_ns, score, strict=True)]
    )
    table = summed(score, performance, SummaryView(pass_bars=2, first_bar=4)).by_bar
    assert {bar: group.notes for bar, group in table.items()} == {4: 26, 5: 26}


def test_document_by_hand() -> None:
    document = assessment(summed(*small()))
    assert document["schema"] == "drum-station/assessment/1"
    assert document["counts"] == {
        "notes": 13, "hits": 14, "matched": 11, "misses": 1, "extras": 1, "wrong_piece": 1, "ignored": 1,
        "played_again": 0, "unknown": 0,
    }  # fmt: skip
    timing = document["timing"]
    assert isinstance(timing, dict)
    assert timing["mean_signed_asynchrony_ms"] == 2.0
    assert document["wrong_pieces"] == [{"written": "snare", "played": "tom_1", "count": 1}]
    assert document["reference"] == "click"
    assert json.loads(json.dumps(document, allow_nan=False)) == document


def test_document_of_silence_has_no_zeroes_for_unknowns() -> None:
    document = assessment(summed(rock_beat(1), Performance.from_hits([])))
    assert document["timing"] == {
        "mean_signed_asynchrony_ms": None, "sd_asynchrony_ms": None, "mean_ci_ms": None, "strokes": 0,
    }  # fmt: skip
    assert document["score"] == 0.0


def test_keys_without_velocity_have_no_dynamics() -> None:
    assert assessment(summed(*small(), SummaryView(hears_velocity=False)))["dynamics"] is None


def rows_of(text: str) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(text)))


def test_pairs_by_hand() -> None:
    score, performance = small()
    rows = rows_of(pairs_csv(score, performance, align(score, performance, clocked=True)))
    assert tuple(rows[0]) == COLUMNS
    assert len(rows) == 13 + 2
    first_snare = next(row for row in rows if row["label"] == "wrong_piece")
    assert (first_snare["note_time_s"], first_snare["note_midi"]) == ("0.500000", "38")
    assert (first_snare["hit_time_s"], first_snare["hit_midi"]) == ("0.500000", "50")
    missed = next(row for row in rows if row["label"] == "miss")
    assert (missed["note_midi"], missed["hit_index"], missed["hit_time_s"], missed["hit_midi"]) == ("36", "", "", "")
    extra = next(row for row in rows if row["label"] == "extra")
    assert (extra["note_index"], extra["note_time_s"], extra["hit_time_s"], extra["hit_midi"]) == (
        "",
        "",
        "1.125000",
        "49",
    )
    assert [row["label"] for row in rows].count("ignored") == 1


def test_pairs_name_every_note_and_hit_once(tmp_path: Path) -> None:
    score, performance = small()
    path = tmp_path / "pairs.csv"
    write_pairs(path, score, performance, align(score, performance, clocked=True))
    rows = rows_of(path.read_text())
    assert sorted(int(r["note_index"]) for r in rows if r["note_index"]) == list(range(13))
    assert sorted(int(r["hit_index"]) for r in rows if r["hit_index"]) == list(range(14))


def every_number(value: Json) -> list[float]:
    if isinstance(value, dict):
        return [n for part in value.values() for n in every_number(part)]
    if isinstance(value, list):
        return [n for part in value for n in every_number(part)]
    return [value] if isinstance(value, float) else []


def test_no_number_is_nan() -> None:
    for performance in (small()[1], Performance.from_hits([]), Performance.from_hits([hit(0, Piece.KICK)])):
        assert all(n == n for n in every_number(assessment(summed(rock_beat(1), performance))))  # noqa: PLR0124
