"""`station animate SCORE --out FILE`: the drummer who plays a score, as video, pictures or motion for others."""

import re
from dataclasses import replace
from math import inf
from pathlib import Path

import numpy as np

from station.cli.animation.animate_motion import WRITERS
from station.cli.animation.animate_options import ENDINGS, AnimateOptions, check_meant, usual_of_loops
from station.cli.console import say, say_infeasible
from station.cli.drummer_options import assigned, drums_of, led_score
from station.cli.input.read_scores import words_of
from station.cli.options.option_fields import Command
from station.core.errors import BadInput
from station.core.units import NS_PER_S, ns_from_s
from station.motion.drummer import Drummer
from station.motion.kinematics.figure import GREATEST_STATURE_M, LEAST_STATURE_M, Figure, figure_of
from station.motion.motion_plan import MotionPlan
from station.motion.style.proposal import PROPOSED, propose_style
from station.motion.style.style import Style
from station.motion.style.style_file import load_style
from station.music.score import Score
from station.scenes.demonstrator import as_taught, figure_for
from station.scenes.score_words import ScoreWords

MIN_FPS, MAX_FPS = 1.0, 1000.0
LEAD_S = 1.0
"""Motion begins so long before its first bar, so that the first preparation is there; our choice."""
AHEAD_S = 4.0
"""Motion knows of the strokes so long after its end: a bar at 60 bpm (our choice; a hand prepares for a second)."""
MOST_BEYOND = 2_000
"""So many strokes may come later and are planned for all the same (our choice: it costs a second)."""
RING_S = 1.0
"""A video goes on so long after the score's end, so that what rings is heard; our choice."""
MOST_LOOP_S = 60.0
"""No GIF lasts longer: tens of megabytes, in which nobody can stop or go back (our choice)."""
_PICTURE, _FILM, _LOOP = ".png", ".mp4", ".gif"
_NUMBER = re.compile(r"%0?\d*d")
"""What numbers pictures in a name."""


def run(options: AnimateOptions) -> int:
    """Draw an instant or some bars, or write the motion of some bars."""
    out = options.out
    ending = out.suffix.lower()
    if ending not in (_PICTURE, _FILM, _LOOP, *WRITERS):
        raise BadInput(out, "", f"expected a name that ends in {ENDINGS}")
    check_meant(options, _made(out))
    if ending == _LOOP:
        options = usual_of_loops(options)
    if ending in (_FILM, _LOOP):
        _check_even(options.picture.size)
    whole = score = led_score(options.score, options.drums)
    style, words = _directed(propose_style(score) if options.style == PROPOSED else load_style(options.style), options)
    if ending == _LOOP:
        score, style = _looped(whole, style, options)
    if ending in WRITERS:
        score = as_far_as_asked(score, options)
    plan = _planned(score, style, options)
    drummer = Drummer(score, plan.kit, plan.figure, style, plan)
    if ending in WRITERS:
        start_s, length_s = _span(drummer.score, options, 0.0)
        times_s = start_s + np.arange(round(length_s * options.fps) + 1) / options.fps
        WRITERS[ending]()(drummer, out, times_s)
        kind = "motion "
    else:
        kind = _draw(drummer, whole, words, options)
    say_infeasible((*drummer.assignment.warnings, *(demand.text for demand in drummer.left_over)))
    say(f"{kind}  {out}")
    return 0


def _directed(style: Style, options: AnimateOptions) -> tuple[Style, ScoreWords]:
    """The style over the bars of a lesson whose teacher changes it, and what stands by the notes.

    Cues that change style or view are left out where another one is asked for.
    """
    words = words_of(options.score)
    taught = style if "style" in options.said else as_taught(style, words.cues)
    cues = tuple(replace(cue, camera="") for cue in words.cues) if "view" in options.said else words.cues
    return taught, replace(words, cues=cues)


def _planned(score: Score, style: Style, options: AnimateOptions) -> MotionPlan:
    """The plan of `score` on the kit, by the drummer and with the hands that are asked for."""
    kit = drums_of(options.score, options.drums)
    return MotionPlan.of(score, kit, _figure(style, options), assigned(score, kit, options.drums))


def _made(out: Path) -> str:
    """What a name asks for."""
    ending = out.suffix.lower()
    if ending == _FILM:
        return "a video"
    if ending == _LOOP:
        return "a GIF"
    if ending != _PICTURE:
        return "motion"
    numbers = out.name.count("%")
    if numbers == 0:
        return "a picture"
    if numbers > 1 or not _NUMBER.search(out.name):
        raise BadInput(out, "", "expected one number such as %05d in the name, and no other %")
    return "numbered pictures"


def _looped(score: Score, style: Style, options: AnimateOptions) -> tuple[Score, Style]:
    """The bars that a GIF shows, as they are played over and over, and the style over them."""
    from station.scenes.film import FilmLoop

    _check_fps(options)
    start, end = _ticks(score, options)
    start_s, end_s = score.tempo_map.seconds_at([start, end]).tolist()
    if end_s - start_s > MOST_LOOP_S:
        fault = f"a GIF lasts {MOST_LOOP_S:g} s at most, these bars {end_s - start_s:.0f} s: choose some of them"
        raise BadInput("--start-bar, --end-bar", "", f"{fault}, or make an .mp4")
    bars = _bars(score, options)
    return FilmLoop.score(score, *bars), FilmLoop.style(style, *bars)


def _draw(drummer: Drummer, whole: Score, words: ScoreWords, options: AnimateOptions) -> str:
    """Draw what the name asks for; returns what it is, for people."""
    from station.cli.animation import animate_pictures as pictures

    made = _made(options.out)
    if made == "a picture":
        pictures.draw_picture(drummer, _moment_s(drummer.score, options), words, options)
        return "picture"
    if made == "a GIF":
        pictures.draw_loop(drummer, whole, _bars(whole, options)[0], words, options)
        return "loop   "
    span = _span(drummer.score, options, RING_S)
    if made == "numbered pictures":
        pictures.draw_sequence(drummer, span, words, options)
        return "pictures"
    pictures.draw_film(drummer, span, words, options)
    return "video  "


def _figure(style: Style, options: AnimateOptions) -> Figure:
    """The drummer who plays."""
    if options.stature is None:
        return figure_for(style, options.drummer)
    if not LEAST_STATURE_M <= options.stature <= GREATEST_STATURE_M:
        expected = f"expected {LEAST_STATURE_M:g} to {GREATEST_STATURE_M:g} metres"
        raise BadInput("--stature", f"{options.stature:g}", expected)
    return figure_of(options.stature)


def _moment_s(score: Score, options: AnimateOptions) -> float:
    """The time that a picture shows."""
    if options.picture.time is not None:
        length_s = score.length_ns / NS_PER_S
        if not 0 <= options.picture.time <= length_s:
            raise BadInput("--time", f"{options.picture.time:g}", f"the score has seconds 0 to {length_s:.3f}")
        return options.picture.time
    start, _ = _ticks(score, options)
    meter = score.tempo_map.meter_at(start)
    if not 1 <= options.picture.beat < meter.beats + 1:
        raise BadInput("--beat", f"{options.picture.beat:g}", f"the bar has beats 1 to {meter.beats}")
    return float(score.tempo_map.seconds_at(start + round((options.picture.beat - 1) * meter.beat_ticks)))


def _span(score: Score, options: AnimateOptions, ring_s: float) -> tuple[float, float]:
    """Where it begins, a little before the first bar, and how long it lasts: to the last bar's end, in seconds.

    Where that is the score's end, `ring_s` more.
    """
    _check_fps(options)
    most_s = options.seconds
    if most_s is not None and not 0 < most_s < inf:
        raise BadInput("--seconds", f"{most_s:g}", "expected a number above 0")
    first, last = _ticks(score, options)
    start_s, end_s = score.tempo_map.seconds_at([first, last]).tolist()
    length_s = end_s - start_s + LEAD_S + (ring_s if last >= score.end_tick else 0.0)
    return start_s - LEAD_S, length_s if most_s is None else min(length_s, most_s)


def as_far_as_asked(score: Score, options: AnimateOptions) -> Score:
    """Of a score that goes on for very long the strokes that are shown, and those soon after, over the same bars."""
    start_s, length_s = _span(score, options, 0.0)
    near = score.until_ns(ns_from_s(start_s + length_s + AHEAD_S))
    return near if len(score) - len(near) > MOST_BEYOND else score


def _check_fps(options: AnimateOptions) -> None:
    if not MIN_FPS <= options.fps <= MAX_FPS:
        raise BadInput("--fps", f"{options.fps:g}", f"expected {MIN_FPS:g} to {MAX_FPS:g} a second")


def _ticks(score: Score, options: AnimateOptions) -> tuple[int, int]:
    """First tick of the first bar, last of the last."""
    first, last = _bars(score, options)
    return score.tempo_map.bar_start(first), score.tempo_map.bar_start(last + 1)


def _bars(score: Score, options: AnimateOptions) -> tuple[int, int]:
    """The first and the last bar, from 0."""
    first = options.start_bar
    last = score.bar_count if options.end_bar is None else options.end_bar
    named = "--start-bar, --end-bar", f"{first}-{last}"
    if not (1 <= first <= score.bar_count and 1 <= last <= score.bar_count):
        raise BadInput(*named, f"the score has bars 1 to {score.bar_count}")
    if last < first:
        raise BadInput(*named, "the last bar is before the first")
    return first - 1, last - 1


def _check_even(size: tuple[int, int]) -> None:
    if any(side % 2 for side in size):
        raise BadInput(
            "--size", "{}x{}".format(*size), "a video's and a GIF's width and height are even numbers of pixels"
        )


COMMAND = Command(AnimateOptions, run)
