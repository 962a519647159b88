"""A human who plays a score and does what a sheet of planted faults says; written from HUMANS alone.

Times: the strokes of a moment share an AR(1) deviation, each has a part of its own, a piece leans a little, all lead
the click; without a click the tempo wanders. Levels scatter. Some strokes are left out and some are added.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from station.bench.rigs.planted.planted_strokes import Floats, Mask, Written, level_db
from station.core.pieces import CLOSED, Piece
from station.core.units import NS_PER_S
from station.music.performance import HIT_DTYPE, Performance

OWN_SHARE = 0.2
"""Share of a stroke's timing variance that is its own: gaps between instruments have an SD of 17 ms where strokes have
27 (HUMANS, Groove MIDI), so a stroke's own SD is 17/√2/27 = .45 of the total."""
LAG_1 = 0.3
"""Lag-1 correlation of asynchronies (HUMANS: .21–.37)."""
PIECE_LEAN_MS = 5.0
"""SD of the lean of a piece against the player's own mean, which is style and no fault."""
LEAD_MS = (-8.0, 4.0)
"""Mean and SD of the lead over a click (HUMANS: hi-hat 2, left hand and kick 10 ms early)."""
VELOCITY_CV = 0.08
"""Coefficient of variation of velocity (HUMANS: professionals 6–10 %)."""
LEVEL_SD_DB = 40 / np.log(10) * VELOCITY_CV
"""The same in dB: 1.4."""
MOST_SDS = 2.0
"""Leads, leans and levels of a faultless player lie within two SDs: leans within 10 ms (HUMANS: full marks)."""
PIECE_LEVEL_DB = 1.0
"""SD of a piece's own level against what is written, which is balance and no fault (HUMANS: 2 dB are free)."""
GRACE_SD_MS = 5.0
"""Scatter of a grace stroke before its main stroke: a flam's 15–40 ms (HUMANS) are 28 ± 2.5 SD."""
LEFT_OUT, ADDED = 0.02, 0.01
OPENNESS_SLIP = 0.01
"""Share of hi-hat strokes on the wrong openness in a faultless take; our choice."""
WANDER_SD, WANDER_PERIOD_S = 0.007, (30.0, 60.0)
"""Slow wander of the tempo without a click: two SDs of one wave are ±1 %, two of two waves ±2 % (HUMANS)."""

_OPEN = 0.8
"""Openness of a hi-hat that is played open by mistake."""


@dataclass(frozen=True, slots=True)
class Run:
    """A segment that is played in one go: the score from and until seconds, begun at `at_s` of the take."""

    from_s: float
    until_s: float
    at_s: float


@dataclass(frozen=True, eq=False)
class Sheet:
    """What the player does otherwise than written; arrays have shape (n,), a row a stroke of the score.

    `late_ms` and `louder_db` are added, `lead_ms` how far graces stand ahead, `sd_ms` a stroke's own total SD (NaN: as
    everybody's), `openness` of hi-hats, `left_out` a chance, `piece` what is struck. `added` is a share of all strokes.
    `fade_db` over the whole take, `speed_up` the share by which the tempo grows in eight bars, `mean_ms` the mean
    against the click (None: the usual lead), `runs` the order in which the music is played (empty: once through).
    """

    late_ms: Floats
    louder_db: Floats
    lead_ms: Floats
    sd_ms: Floats
    openness: Floats
    left_out: Floats
    piece: NDArray[np.uint8]
    added: float = ADDED
    fade_db: float = 0.0
    speed_up: float = 0.0
    mean_ms: float | None = None
    runs: tuple[Run, ...] = ()

    @classmethod
    def as_written(cls, written: Written) -> "Sheet":
        """Nothing planted."""
        n, notes = len(written.score), written.score.notes
        return cls(
            late_ms=np.zeros(n),
            louder_db=np.zeros(n),
            lead_ms=notes["lead_ms"].astype(np.float64),
            sd_ms=np.full(n, np.nan),
            openness=np.where(notes["piece"] == Piece.HIHAT, np.nan_to_num(notes["openness"], nan=CLOSED), np.nan),
            left_out=np.full(n, LEFT_OUT),
            piece=notes["piece"].copy(),
        )

    def later(self, by_ms: Floats) -> "Sheet":
        """The same with strokes that much later."""
        return replace(self, late_ms=self.late_ms + by_ms)

    def louder(self, by_db: Floats) -> "Sheet":
        """The same with strokes that much louder."""
        return replace(self, louder_db=self.louder_db + by_db)


@dataclass(frozen=True, slots=True)
class Conditions:
    """Under what a take is played: total SD of a stroke's time, and whether there is a click."""

    sd_ms: float
    clocked: bool


def style(count: int, rng: np.random.Generator) -> Floats:
    """What a player is like: normal values of SD 1, those beyond two SDs drawn again."""
    values = rng.normal(size=count)
    while (far := np.abs(values) > MOST_SDS).any():
        values[far] = rng.normal(size=int(far.sum()))
    return values


def leans_of(written: Written) -> Floats:
    """Takes the player's own mean out of the pieces' leans: (p, p), pieces in the order of `written.pieces`."""
    share = np.array([written.piece(p).sum() for p in written.pieces]) / max(int(written.main.sum()), 1)
    return np.asarray(np.eye(len(share)) - share[None, :], np.float64)


def ar_1(count: int, lag_1: float, rng: np.random.Generator) -> Floats:
    """Stationary noise of SD 1."""
    steps = rng.normal(size=count)
    for k in range(1, count):
        steps[k] = lag_1 * steps[k - 1] + np.sqrt(1 - lag_1**2) * steps[k]
    return steps


def play(written: Written, sheet: Sheet, conditions: Conditions, rng: np.random.Generator) -> Performance:
    """One take; times are score time where there is a click, else they begin anywhere."""
    row, at_s, late_ms = strokes_played(written, sheet, conditions, rng)
    hits = _hits(written, sheet, row, at_s + late_ms / 1000, rng)
    return Performance.from_array(np.concatenate([hits, _additions(written, sheet, hits, rng)]))


def strokes_played(
    written: Written, sheet: Sheet, conditions: Conditions, rng: np.random.Generator
) -> tuple[NDArray[np.int64], Floats, Floats]:
    """The row of each stroke, when the player's own tempo has it, and by how many ms it comes later than that."""
    row, at_s = _order(written, sheet)
    kept = rng.random(len(row)) >= sheet.left_out[row]
    row, at_s = row[kept], at_s[kept]
    if not conditions.clocked:
        at_s = _at_own_tempo(written, sheet, at_s, rng)
    late_ms = _deviation_ms(written, sheet, conditions, row, at_s, rng)
    ahead_ms = np.where(written.main[row], 0, sheet.lead_ms[row] + rng.normal(0, GRACE_SD_MS, len(row)))
    return row, at_s, late_ms - ahead_ms


def _order(written: Written, sheet: Sheet) -> tuple[NDArray[np.int64], Floats]:
    """The rows that are played in their order, and when they would sound at the written tempo."""
    if not sheet.runs:
        return np.arange(len(written.score)), written.time_s
    parts = []
    for run in sheet.runs:
        rows = np.flatnonzero((written.time_s >= run.from_s - 1e-6) & (written.time_s < run.until_s - 1e-6))
        parts.append((rows, written.time_s[rows] - run.from_s + run.at_s))
    return np.concatenate([rows for rows, _ in parts]), np.concatenate([at_s for _, at_s in parts])


def _at_own_tempo(written: Written, sheet: Sheet, at_s: Floats, rng: np.random.Generator) -> Floats:
    """The times with a tempo of the player's own: a rate, two slow waves, and what is planted."""
    eight_bars_s = 8 * written.score.length_ns / NS_PER_S / written.score.bar_count
    time_s = np.linspace(0, float(at_s.max(initial=1)) + 1, 4000)
    rate = np.full_like(time_s, 1 + rng.uniform(-0.03, 0.03))
    for _ in range(2):
        period_s, phase = rng.uniform(*WANDER_PERIOD_S), rng.uniform(0, 2 * np.pi)
        rate += WANDER_SD * np.sin(2 * np.pi * time_s / period_s + phase)
    rate *= 1 + sheet.speed_up * time_s / eight_bars_s
    passed = np.concatenate([[0], np.cumsum(np.diff(time_s) / ((rate[1:] + rate[:-1]) / 2))])
    return np.asarray(np.interp(at_s, time_s, passed) + rng.uniform(0.5, 5), np.float64)


def _deviation_ms(
    written: Written,
    sheet: Sheet,
    conditions: Conditions,
    row: NDArray[np.int64],
    at_s: Floats,
    rng: np.random.Generator,
) -> Floats:
    """How late each played row is; a grace is as late as its main stroke."""
    moment = np.unique(at_s, return_inverse=True)[1]
    main_rows, inverse = np.unique(np.stack([moment, written.main_of[row]]), axis=1, return_inverse=True)
    shared = ar_1(int(moment.max(initial=0)) + 1, LAG_1 / (1 - OWN_SHARE), rng)
    own = rng.normal(size=main_rows.shape[1])
    mains, piece = main_rows[1], written.score.notes["piece"][main_rows[1]]
    noise = conditions.sd_ms * (np.sqrt(1 - OWN_SHARE) * shared[main_rows[0]] + np.sqrt(OWN_SHARE) * own)
    extra_sd = np.sqrt(np.maximum(np.nan_to_num(sheet.sd_ms[mains]) ** 2 - conditions.sd_ms**2, 0))
    noise += extra_sd * _per_limb(written.score.notes["limb"][mains], rng)
    lean = PIECE_LEAN_MS * (leans_of(written) @ style(len(written.pieces), rng))[np.searchsorted(written.pieces, piece)]
    mean = LEAD_MS[0] + LEAD_MS[1] * float(style(1, rng)[0]) if conditions.clocked else 0.0
    mean = mean if sheet.mean_ms is None else sheet.mean_ms
    late: Floats = noise + lean + mean + sheet.late_ms[mains]
    return late[inverse.reshape(-1)]


def _per_limb(limb: NDArray[np.int8], rng: np.random.Generator) -> Floats:
    noise = np.zeros(len(limb))
    for each in np.unique(limb):
        noise[limb == each] = ar_1(int((limb == each).sum()), LAG_1, rng)
    return noise


def _hits(
    written: Written, sheet: Sheet, row: NDArray[np.int64], at_s: Floats, rng: np.random.Generator
) -> NDArray[np.void]:
    notes = written.score.notes[row]
    hits = np.zeros(len(row), HIT_DTYPE)
    hits["at_ns"] = np.rint(at_s * NS_PER_S).astype(np.int64)
    hits["position"], hits["limb"] = np.nan, -1
    for name in ("zone", "articulation"):
        hits[name] = notes[name]
    through = (at_s - at_s.min(initial=0)) / max(float(np.ptp(at_s)) if len(at_s) else 1.0, 1e-9)
    level = level_db(notes["velocity"]) + sheet.louder_db[row] + sheet.fade_db * through
    level += PIECE_LEVEL_DB * style(len(Piece), rng)[notes["piece"]] + rng.normal(0, LEVEL_SD_DB, len(row))
    hits["velocity"] = np.clip(np.rint(127 * 10 ** (level / 40)), 1, 127)
    slipped = rng.random(len(row)) < OPENNESS_SLIP
    openness = np.where(slipped, _OPEN - sheet.openness[row], sheet.openness[row])
    hits["openness"] = np.clip(openness, 0, 1)
    hits["piece"] = sheet.piece[row]
    return hits


def _additions(written: Written, sheet: Sheet, hits: NDArray[np.void], rng: np.random.Generator) -> NDArray[np.void]:
    """Strokes that nobody wrote: copies of played ones, half of them bounces, half anywhere."""
    extra = hits[rng.random(len(hits)) < sheet.added].copy()
    bounce_s = rng.uniform(0.09, 0.2, len(extra))
    beat_s = written.score.length_ns / NS_PER_S / max(written.score.end_tick / written.beat_ticks, 1)
    anywhere_s = rng.uniform(0.2, 0.8, len(extra)) * beat_s
    after_s = np.where(rng.random(len(extra)) < 1 / 2, bounce_s, anywhere_s)
    extra["at_ns"] += np.rint(after_s * NS_PER_S).astype(np.int64)
    return extra


def wrong_openness(sheet: Sheet, which: Mask, share: float, rng: np.random.Generator) -> Sheet:
    """A share of the hi-hats `which` played open for closed or closed for open."""
    rows = np.flatnonzero(which)
    chosen = rng.permutation(rows)[: int(np.ceil(share * len(rows)))]
    openness = sheet.openness.copy()
    openness[chosen] = np.where(openness[chosen] >= 1 / 2, CLOSED, _OPEN)
    return replace(sheet, openness=openness)


def astray(sheet: Sheet, written: Written, piece: Piece, share: float, rng: np.random.Generator) -> Sheet:
    """A share of a piece's strokes on another piece for hands, one that is written elsewhere if there is one."""
    own = [p for p in written.pieces if p not in (piece, Piece.KICK, Piece.HIHAT_PEDAL)]
    instead = rng.choice(np.array(own or [p for p in (Piece.TOM_1, Piece.SNARE) if p != piece], np.uint8))
    rows = rng.permutation(np.flatnonzero(written.piece(piece)))
    struck = sheet.piece.copy()
    struck[rows[: int(np.ceil(share * len(rows)))]] = instead
    return replace(sheet, piece=struck)
