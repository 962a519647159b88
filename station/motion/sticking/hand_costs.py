"""What it costs a hand to play a note: the terms that the choice of hands weighs.

A cost of 1 is what a drummer would go out of the way for a little. A note's cost is the sum of what it costs alone
(`alone`), after what the hand played last (`after_own`) and beside what the other hand played last (`beside`). Each
term has a name, because the term that decided becomes the reason that is shown. Times in seconds, lengths in metres.
"""

import math

from station.core.pieces import Limb, Piece
from station.motion.sticking.hand_notes import AT_ONCE_S, EASY_REPEAT_S, LEFT, RIGHT, HandNotes
from station.motion.strokes.bounces import AGAIN_S
from station.motion.strokes.hand_events import SAME_STROKE_S

# --- speeds -----------------------------------------------------------------------------------------------------------

CRUSHED_S = 0.045
"""Two strokes of one hand on one piece this near are a buzz, no rebound (second bounce after 50–90 ms)."""
BOUNCE_S = 0.105
"""Up to here one hand plays two notes as a rebound, not as two strokes (second bounce after 50–90 ms)."""
RELAXED_S = 0.25
"""From here on a stroke after another of the same hand costs nothing (our choice)."""
TRAVEL_S_PER_M = 0.25
"""Drummers take single strokes around the toms, half a metre a hand, up to about 200 bpm: 150 ms (our choice)."""
STRIKE_S = 0.05
"""A stroke needs this besides the travel (our choice)."""
HURRIED = 0.7
"""The share of the time that a travel may need before it becomes a hurry (our choice)."""
CROSSING_FADES_S = 0.6
"""A hand that has not played for so long is out of the way."""
PHRASE_S = 1.0
"""After so long a rest the leading hand begins (our choice)."""

# --- prices: our choices, tuned on the patterns that the tests name ---------------------------------------------------

WRITTEN = 1e6
IMPOSSIBLE = 1000.0
CRUSHED = 200.0
UNEVEN = 12.0
BOUNCED_AGAIN = 5.0
GRACE = 8.0
LATE = 7.0
SLOW = 4.0
TIRING = 0.6
BOUNCE = 2.0
SKIP = 0.6
LATE_BOUNCE = 0.25
METRE = 0.8
CROSSING = 1.8
FAR_CROSSING = 100.0
NATURAL = 0.6
FIRM = 1.8
OSTINATO = 0.9
SWITCH = 0.6
LAID = 1.0
BOTH_LIE = 6.0
HOME = 0.15
BEGIN = 0.1

MIDDLE_M = 0.10
"""So near the middle neither side of the kit is a hand's own."""
CROSSING_MARGIN_M = 0.02
"""Hands this near in x are beside each other, not crossed (half of what parts the two snare spots)."""
FULL_CROSSING_M = 0.2
"""Hands so far past each other are fully crossed."""
FAR_CROSSING_M = 0.56
"""Hands farther past each other than this have one arm across the other, and it grows worse."""


# --- a note alone -----------------------------------------------------------------------------------------------------

ALONE = (
    "written",
    "the ostinato's hand",
    "natural sticking",
    "the cross-stick's hand",
    "its own side of the kit",
    "the leading hand begins",
)


def alone(notes: HandNotes, i: int, hand: int) -> tuple[float, ...]:
    """What note `i` costs `hand` whatever came before: a price for each name in `ALONE`."""
    x = notes.spot[hand][i][0]
    written = WRITTEN if notes.written[i] not in (Limb.UNKNOWN, hand) else 0.0
    ostinato = natural = 0.0
    if notes.ostinato[i]:
        ostinato = OSTINATO if hand != notes.ostinato_hand(i) else 0.0
    elif hand != notes.natural[i]:
        natural = FIRM if notes.firm[i] else NATURAL
    laid = LAID if notes.laid[i] and hand == notes.lead else 0.0  # drummers lay the hand that has the backbeat
    home = HOME * max(0.0, (x if hand == LEFT else -x) - MIDDLE_M)
    begins = i == 0 or notes.time_s[i] - notes.time_s[i - 1] > PHRASE_S
    return written, ostinato, natural, laid, home, BEGIN if begins and hand != notes.lead else 0.0


# --- after the same hand's last note ----------------------------------------------------------------------------------

AFTER_OWN = ("the other hand is elsewhere", "its partner in the ornament", "the nearer hand", "too quick for one hand")


def after_own(notes: HandNotes, i: int, hand: int, own: int, bounced: bool) -> tuple[float, ...]:
    """What note `i` costs `hand` after its last, `own` (−1: none), itself `bounced` or not; as `AFTER_OWN` names."""
    paired = notes.paired[i]
    partner = GRACE if paired and (own == i - 1) != (paired == 1) else 0.0
    if own < 0:
        return 0.0, partner, 0.0, 0.0
    gap = notes.time_s[i] - notes.time_s[own]
    if notes.piece[own] == notes.piece[i]:
        crushed = IMPOSSIBLE if gap <= SAME_STROKE_S else CRUSHED * max(0.0, 1.0 - gap / CRUSHED_S)
        return crushed, partner, 0.0, _repeat(notes, i, own, bounced)
    if gap < AT_ONCE_S:  # the nearer, the worse, so that what must be impossible is so where it is so most
        return IMPOSSIBLE * (3.0 - 2.0 * gap / AT_ONCE_S), partner, 0.0, 0.0
    return 0.0, partner, _travel(gap, math.dist(notes.spot[hand][i], notes.spot[hand][own])), 0.0


def _repeat(notes: HandNotes, i: int, own: int, bounced: bool) -> float:
    """The price of one hand's next stroke, after `own`, on the same piece; none where no hand is free to spare it."""
    if notes.again[i]:
        return 0.0
    gap_s = notes.time_s[i] - notes.time_s[own]
    if gap_s < BOUNCE_S:
        price = 0.0 if notes.paired[i] == 1 else SKIP if notes.ostinato[i] else BOUNCE
        if bounced:  # a third stroke has no rebound left to live on, unless the stick bounces softer and softer
            again = gap_s < AGAIN_S and notes.velocity[i] < notes.velocity[own]
            price += BOUNCED_AGAIN if again else UNEVEN
        return price if notes.odd[i] else price + LATE_BOUNCE
    price = SLOW * max(0.0, EASY_REPEAT_S - gap_s) / (EASY_REPEAT_S - BOUNCE_S)
    if not bounced:  # two are easy, it is the third that tires
        price = min(price, BOUNCE)
    return price if notes.ostinato[i] else price + TIRING * max(0.0, RELAXED_S / gap_s - 1.0)


def _travel(gap_s: float, way_m: float) -> float:
    """The price of moving to another piece in the time there is."""
    need = STRIKE_S + TRAVEL_S_PER_M * way_m
    return METRE * way_m + LATE * max(0.0, need / gap_s - HURRIED) ** 2


def is_double(notes: HandNotes, i: int, own: int) -> bool:
    """Whether a hand that last played `own` plays note `i` as the second of a double."""
    return own >= 0 and notes.time_s[i] - notes.time_s[own] < EASY_REPEAT_S and notes.piece[own] == notes.piece[i]


def is_rebound(notes: HandNotes, i: int, own: int) -> bool:
    """Whether that double is so quick that its second stroke lives on the first one's rebound."""
    return is_double(notes, i, own) and notes.time_s[i] - notes.time_s[own] < BOUNCE_S


# --- beside the other hand's last note --------------------------------------------------------------------------------

BESIDE = ("the hands stay uncrossed", "the ostinato stays in its hand", "one hand lies on the drum")


def beside(notes: HandNotes, i: int, hand: int, other: int) -> tuple[float, ...]:
    """What note `i` costs `hand` when the other hand played `other` last (−1: nothing); as `BESIDE` names."""
    if other < 0:
        return 0.0, 0.0, 0.0
    fresh = 1.0 - (notes.time_s[i] - notes.time_s[other]) / CROSSING_FADES_S
    if fresh <= 0.0:
        return 0.0, 0.0, 0.0
    same = notes.piece[other] == notes.piece[i]
    switched = SWITCH * fresh if same and notes.ostinato[i] else 0.0
    both_lie = BOTH_LIE if same and notes.laid[i] and notes.laid[other] else 0.0
    return CROSSING * fresh * _crossed(notes, i, hand, other), switched, both_lie


def _crossed(notes: HandNotes, i: int, hand: int, other: int) -> float:
    """How far the hands are crossed, 0–1, and more for the arms; none in home posture, the leading hand on the hat."""
    over = notes.spot[1 - hand][other][0] - notes.spot[hand][i][0]
    over = (over if hand == RIGHT else -over) - CROSSING_MARGIN_M
    if over <= 0.0:
        return 0.0
    own_piece, other_piece = notes.piece[i], notes.piece[other]
    lead_on, other_on = (own_piece, other_piece) if hand == notes.lead else (other_piece, own_piece)
    if lead_on == Piece.HIHAT and other_on == Piece.SNARE and not notes.open_handed:
        return 0.0
    return min(1.0, over / FULL_CROSSING_M) + FAR_CROSSING * max(0.0, over - FAR_CROSSING_M)


def settled_s(notes: HandNotes) -> float:
    """After so long it no longer matters when a hand played its last note, only where."""
    spots = [point for hand in notes.spot for point in dict.fromkeys(map(tuple, hand))]
    farthest = max((math.dist(a, b) for a in spots for b in spots), default=0.0)
    return max(CROSSING_FADES_S, RELAXED_S, (STRIKE_S + TRAVEL_S_PER_M * farthest) / HURRIED)
