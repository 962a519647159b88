"""The facts of a page about one session, from its result and its report."""

from collections.abc import Iterator
from datetime import datetime

import numpy as np

from station.core.errors import BadInput
from station.core.labels import name_of, piece_name
from station.core.pieces import Dynamic, Piece
from station.core.units import NS_PER_S, PPQ
from station.engine.engine import KEYBOARD
from station.music.judgement import Label
from station.practice.history.session_files import CAPTURE_NAME, DOCUMENT_NAME
from station.practice.now.tempo_now import tempi_in_words, tempo_at
from station.practice.session.session import SessionResult
from station.render.report.page.session_page import (
    JudgedBars,
    LoudnessRow,
    SessionPage,
    TempoLine,
)
from station.render.report.result_facts import headline
from station.scenes.report.kept_session import KeptSession
from station.scenes.report.note_states import note_passes
from station.scenes.report.page_timing import (
    Document,
    Spreads,
    bar_figures,
    group_figures,
    hand_figures,
    number,
    stroke_timing,
    table,
)
from station.scenes.report.page_words import (
    choices,
    exam_result,
    foot,
    next_sentences,
    pass_rows,
    passes_heading,
    remarks,
    word_lists,
)
from station.scenes.report.practised_section import practised_section, section_notes
from station.scenes.result_tables import session_facts
from station.scenes.score_words import section_names
from station.scoring.matching.hit_windows import Level

_KINDS = {Dynamic.GHOST: "ghost", Dynamic.NORMAL: "plain", Dynamic.ACCENT: "accent"}
_NO_REPORT = (KeyError, TypeError, ValueError, AttributeError, IndexError, AssertionError, OverflowError)


def session_page(kept: KeptSession, source: str) -> SessionPage:
    """The facts of a session; raises `BadInput` of `source` where its report lacks what every report of ours has."""
    try:
        return _page(kept)
    except _NO_REPORT as fault:  # it was edited: our own words look for what our own reports have
        report = f"{source.removesuffix(CAPTURE_NAME)}{DOCUMENT_NAME}" if source.endswith(CAPTURE_NAME) else source
        lacks = f": it lacks {fault.args[0]}" if isinstance(fault, KeyError) and fault.args else ""
        raise BadInput(report, "", f"is no whole report of a session{lacks}") from fault


def _page(kept: KeptSession) -> SessionPage:
    result, document = kept.result, kept.document
    facts, said, counts = session_facts(result, document), table(document["session"]), table(document["counts"])
    spreads = Spreads(result)
    return SessionPage(
        title=str(said["title"]),
        student=str(said["student"]),
        when=_moment(kept.at),
        labels=tuple(_labels(result, document)),
        score=number(document["score"]),
        right=int(table(document)["right"]),
        notes=int(counts["notes"]),
        misses=int(counts["misses"]),
        wrong=int(counts["wrong_piece"]),
        extras=int(counts["extras"]),
        unknown=int(counts["unknown"]),
        played_again=int(counts["played_again"]),
        headline=f"{headline(facts)[:1].upper()}{headline(facts)[1:]}.",
        praise=None if document["praise"] is None else str(document["praise"]),
        next_steps=next_sentences(document),
        choices=choices(document),
        remarks=(*kept.remarks, *remarks(document)),
        exam=None if kept.exam is None else exam_result(kept.exam),
        bars=_bars(result),
        timing=stroke_timing(document, spreads),
        pieces=tuple(group_figures(table(document["per_piece"]), spreads.pieces, name_of)),
        limbs=tuple(group_figures(table(document["per_limb"]), spreads.limbs, lambda limb: limb.replace("_", " "))),
        hands=tuple(hand_figures(document)),
        by_bar=tuple(bar_figures(result, document, spreads)),
        loudness=_loudness(result, document),
        tempo=_tempo(result, document),
        passes_heading=passes_heading(document),
        passes=pass_rows(document),
        lists=word_lists(document),
        foot=foot(document),
    )


def _moment(at: datetime | None) -> str:
    return "" if at is None else f"{at.day} {at:%B %Y, %H:%M}"


def _labels(result: SessionResult, document: Document) -> Iterator[tuple[str, str]]:
    """What was practised, on what, and how it was judged."""
    plan, said = result.plan, table(document["session"])
    first, last = said["bars"]
    passes = "1 pass" if said["passes"] == 1 else f"{said['passes']} passes"
    yield "Bars", f"{f'bars {first}–{last}' if first != last else f'bar {first}'}, {passes}"
    yield "Tempo", tempi_in_words(plan, result.score)
    yield "Played", _minutes(float(said["played_s"])) + ("" if said["complete"] else ", stopped early")
    yield "Judged as", Level(str(document["level"])).words
    yield "Device", str(said["device"]) if said["device"] is not None else "none was heard"
    if result.felt:
        yield "Sensors", "on the sticks"


def _minutes(seconds: float) -> str:
    return f"{seconds:.0f} s" if seconds < 60 else f"{int(seconds) // 60} min {int(seconds) % 60} s"


# --- bars, loudness, tempo --------------------------------------------------------------------------------------------


def _bars(result: SessionResult) -> JudgedBars:
    plan, section = result.plan, practised_section(result.plan)
    notes = note_passes(result, section, section_notes(result, section))
    return JudgedBars(
        section=section,
        notes=notes,
        first_bar=plan.bars[0] + 1,
        sections=section_names(plan.lesson.sections, plan.bars[0], section.bar_count),
        beats_a_minute=round(tempo_at(section.tempo_map, 0, plan.lesson.beat_ticks), 1),
        beat_ticks=plan.lesson.beat_ticks,
        on_time_ms=plan.level.windows.on_time_ms,
        passes=plan.passes,
    )


def _loudness(result: SessionResult, document: Document) -> tuple[LoudnessRow, ...]:
    """Rows of pieces and marks that were played; none where the input cannot tell loud from soft."""
    if document["dynamics"] is None or result.device == KEYBOARD:
        return ()
    alignment, notes = result.alignment, result.score.notes
    is_played = (alignment.note_label == Label.MATCH) & ~result.score.is_grace
    played = np.zeros(len(notes))
    played[is_played] = result.performance.fine_velocity[alignment.hit_of_note[is_played]]
    rows = []
    for piece in np.unique(notes["piece"][is_played]).tolist():
        for dynamic, kind in _KINDS.items():
            here = is_played & (notes["piece"] == piece) & (notes["dynamic"] == dynamic)
            if here.any():
                written = float(np.median(notes["velocity"][here]))
                rows.append(LoudnessRow(piece_name(Piece(piece)), kind, written, played[here]))
    return tuple(rows)


def _tempo(result: SessionResult, document: Document) -> TempoLine:
    """The report's tempo curve in the lesson's beat, and what was asked, bar by bar where it changes."""
    told, plan, score = table(document["tempo"]), result.plan, result.score
    beat = PPQ / plan.lesson.beat_ticks
    ticks = [change.tick for change in score.tempo_map.tempos if change.tick < score.end_tick]
    drift, bars = told["drift_ci"], sorted(told["bars"], key=lambda bar: float(bar["at_s"]))
    median = number(told["median_bpm"])
    return TempoLine(
        at_s=np.array([float(bar["at_s"]) for bar in bars]),
        beats_a_minute=np.array([float(bar["tempo_bpm"]) * beat for bar in bars]),
        asked_s=np.asarray(score.tempo_map.seconds_at(ticks), np.float64),
        asked=np.array([tempo_at(score.tempo_map, tick, plan.lesson.beat_ticks) for tick in ticks]),
        end_s=score.length_ns / NS_PER_S,
        asks="tempo that was asked for" if plan.click is None else "click",
        median=None if median is None else median * beat,
        drift=number(told["drift_pct_per_minute"]),
        drift_ci=None if drift is None else (float(drift[0]), float(drift[1])),
    )
