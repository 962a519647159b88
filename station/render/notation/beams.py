"""What joins the stems of a group of notes: beams, flags, and a tuplet's number under its bracket.

Units are staff spaces, y down; x counts from a note's time, to which an `Anchor` ties what is drawn. Proportions follow
Gould, "Behind Bars" (2011): beams half a space, a stem right of its head when up.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field

from station.music.tempo import TempoMap
from station.render.notation.note_shapes import draw_figures, figures_width
from station.render.notation.spelling.beaming import BeamSpan
from station.render.notation.staff_rows import TUPLET_SCALE, flag_overhang
from station.render.palette import INK
from station.render.text.draw_list import DrawList
from station.render.text.sign_outlines import BEAM, BEAM_STEP, BRACKET_LINE, STEM, sign_box

STEM_X = sign_box("head_round").right - STEM / 2
"""How far from its head's middle a stem stands."""
_STUB = 1.1
_GAP, _HOOK = 0.2, 0.5
"""What a bracket leaves free on either side of its number, and how far its ends reach and hang over."""


@dataclass(frozen=True, slots=True)
class StaffVoice:
    """Hands or feet: `way` −1 stems up, +1 stems down."""

    way: int

    @property
    def is_up(self) -> bool:
        """Whether its stems go up."""
        return self.way < 0

    @property
    def stem_x(self) -> float:
        """Where its stems stand beside the middle of a head."""
        return -self.way * STEM_X


HANDS, FEET = StaffVoice(-1), StaffVoice(1)


@dataclass(frozen=True, slots=True)
class Anchor:
    """Ties what `draw_list` draws to the score's time; `known` has the seconds of ticks that were asked for."""

    draw_list: DrawList
    tempo: TempoMap
    known: dict[int, float] = field(default_factory=dict, repr=False, compare=False)

    def at(self, tick: int) -> None:
        """What follows hangs on `tick` of the score."""
        self.draw_list.time_s, self.draw_list.span_s = self.seconds(tick), 0.0

    def until(self, tick: int) -> None:
        """What follows is drawn out from where it hangs to `tick` of the score."""
        self.draw_list.span_s = self.seconds(tick) - self.draw_list.time_s

    def seconds(self, tick: int) -> float:
        """The score's time at `tick`."""
        if tick not in self.known:
            self.known[tick] = float(self.tempo.seconds_at(tick))
        return self.known[tick]


def draw_flags(anchor: Anchor, tick: int, count: int, voice: StaffVoice, beam_y: float) -> None:
    """So many flags on the stem at `tick`, none beyond its end at `beam_y`."""
    anchor.at(tick)
    name = f"flag_{4 << count}" if voice.is_up else f"flag_{4 << count}_down"
    y = beam_y - voice.way * flag_overhang(count)
    anchor.draw_list.sign(name, (voice.stem_x - STEM / 2, y), INK)


def draw_beams(
    anchor: Anchor, spans: Sequence[BeamSpan], ticks: Sequence[int], voice: StaffVoice, beam_y: float
) -> None:
    """Beams over stems at `ticks`, the outermost at `beam_y`."""
    for span in spans:
        y = beam_y - voice.way * span.level * BEAM_STEP - (0.0 if voice.is_up else BEAM)
        anchor.at(ticks[span.first])
        if span.stub:
            anchor.draw_list.box((voice.stem_x - (_STUB if span.stub < 0 else 0.0), y), (_STUB, BEAM), INK)
        else:
            anchor.until(ticks[span.last])
            anchor.draw_list.box((voice.stem_x - STEM / 2, y), (STEM, BEAM), INK)
            anchor.draw_list.span_s = 0.0


def draw_tuplet(
    anchor: Anchor, number: int, ends: tuple[int, int], voice: StaffVoice, y: float, with_bracket: bool
) -> None:
    """A tuplet's `number` midway between two ticks, its baseline at `y`; the bracket is for one without a beam."""
    start_s, end_s = anchor.seconds(ends[0]), anchor.seconds(ends[1])
    half = figures_width(str(number), "tuplet") * TUPLET_SCALE / 2
    if with_bracket:
        middle = y - sign_box("tuplet_0").top * TUPLET_SCALE / 2
        _bracket(anchor.draw_list, (start_s, end_s), voice, (middle, half + _GAP))
    anchor.draw_list.time_s, anchor.draw_list.span_s = (start_s + end_s) / 2, 0.0
    draw_figures(anchor.draw_list, str(number), (voice.stem_x - half, y), INK, TUPLET_SCALE, "tuplet")


def _bracket(draw_list: DrawList, ends_s: tuple[float, float], voice: StaffVoice, middle: tuple[float, float]) -> None:
    """A line over a tuplet with a hook at each end; `middle`: its height, and half the gap for its number."""
    (start_s, end_s), tip, (y, gap) = ends_s, _HOOK * -voice.way, middle
    centre_s, right = (start_s + end_s) / 2, _HOOK + voice.stem_x
    for begin_s, x, end_x in ((start_s, -_HOOK, voice.stem_x - gap), (centre_s, voice.stem_x + gap, right)):
        draw_list.time_s, draw_list.span_s = begin_s, centre_s - start_s
        draw_list.box((x, y - BRACKET_LINE / 2), (end_x - x, BRACKET_LINE), INK)
    draw_list.span_s = 0.0
    for at_s, x in ((start_s, -_HOOK + BRACKET_LINE / 2), (end_s, right - BRACKET_LINE / 2)):
        draw_list.time_s = at_s
        draw_list.line((x, y), (x, y + tip), BRACKET_LINE, INK)
