"""A session's take for a page: the drummer who plays what the student played, its sound with the click, and its times.

All strokes are the student's: their times, velocities and hi-hat openness, extras too. Who plays them is the
demonstrator; a stroke that is a note's match is played by the limb that plays the note.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Limb
from station.core.settings import Settings
from station.core.units import NS_PER_S
from station.motion.drummer import Drummer
from station.motion.kinematics.posture import seated
from station.motion.motion_plan import MotionPlan
from station.motion.sticking.limbs import limbs_and_reasons
from station.motion.style.automation_lanes import in_passes
from station.music.as_played import score_as_played
from station.music.judgement import Label
from station.music.performance import Performance
from station.music.score import Score
from station.practice.session.cues.stroke_cues import demonstration_cues, in_order
from station.practice.session.session import SessionResult
from station.render.model.drummer_model import model_bytes
from station.render.report.take.shown_take import ShownTake
from station.scenes.demonstrator import Demonstrator, as_taught, demonstrator_of
from station.scenes.report.take_clicks import take_clicks
from station.scenes.report.take_clock import TakeClock
from station.scenes.report.take_kit import take_kit
from station.scenes.report.take_notes import extras_in_words, shown_passes, shown_strokes
from station.scenes.report.take_views import shown_views
from station.scenes.soundtrack import Sounds, Soundtrack
from station.sound.drum_kit import Frames
from station.sound.samples.load_kit import load_kit

RING_S = 1.5
"""A take goes on so long after its last stroke, so that what rings is heard (our choice)."""
LONGEST_S = 480.0
"""So much of a take is shown: a page of eight minutes has some 12 MB (our choice)."""
SEARCHES = 30
"""Who strikes at random has hundreds of moments at which sticks are in each other's way, and planning them took half a
minute: in the worst of them a way round is looked for, which takes one or two seconds (our choice)."""
_BLOCK_S = 1.0


def take_media(result: SessionResult, settings: Settings) -> ShownTake:
    """The take of a session, played by the drummer and with the sounds of the settings.

    Raises `DeviceError` where sound cannot be encoded, `BadInput` for a drum kit that cannot be loaded.
    """
    from station.render.files.opus_file import RATE_HZ

    demonstrator = demonstrator_of(settings, lambda _: None)
    return shown_take(result, demonstrator, Sounds(load_kit(settings.drums, RATE_HZ), settings.click))


def shown_take(result: SessionResult, demonstrator: Demonstrator, sounds: Sounds) -> ShownTake:
    """The take of a session, played by a `demonstrator`; raises `DeviceError` where sound cannot be encoded."""
    from station.render.files.opus_file import opus_file

    clock = TakeClock.of(result)
    length_s = _length_s(result, clock)
    end_s = min(length_s, LONGEST_S)
    drummer = take_drummer(result, clock, demonstrator)
    cues = [demonstration_cues(drummer.score)]
    if sounds.click is not None:
        cues.append(take_clicks(result.plan, clock))
    strokes = shown_strokes(result, clock)
    return ShownTake(
        model=model_bytes(drummer, 0.0, end_s),
        sound=opus_file(_sound(Soundtrack(in_order(cues), sounds), end_s)),
        length_s=end_s,
        passes=shown_passes(result, clock, end_s),
        strokes=tuple(stroke for stroke in strokes if stroke.time_s < end_s),
        views=shown_views(drummer),
        remark=_remark(result, length_s),
    )


def take_drummer(result: SessionResult, clock: TakeClock, demonstrator: Demonstrator) -> Drummer:
    """Who plays the student's strokes, time 0 being the take's."""
    plan = result.plan
    score = score_as_played(_with_limbs(result).shifted(clock.lead_ns), clock.tempo_map, plan.lesson.title)
    score = replace(score, end_tick=max(score.end_tick, clock.lead.end_tick + plan.score.end_tick))
    passes = plan.score.bar_count // plan.section.bar_count
    style = in_passes(as_taught(demonstrator.style, plan.lesson.cues), plan.first_bar, plan.section.bar_count, passes)
    motion = MotionPlan.of(score, seated(take_kit(plan), demonstrator.figure), demonstrator.figure)
    return Drummer(score, motion.kit, motion.figure, style, motion, motion.hands(style, SEARCHES))


def _with_limbs(result: SessionResult) -> Performance:
    """What was played, every match by the limb of its note where nobody felt another one."""
    hits = result.performance.hits.copy()
    note = result.alignment.note_of_hit
    limbs = _note_limbs(result.score, result)
    same = (result.alignment.hit_label == Label.MATCH) & (hits["limb"] == Limb.UNKNOWN) & (note >= 0)
    same[same] = result.score.notes["piece"][note[same]] == hits["piece"][same]
    hits["limb"][same] = limbs[note[same]]
    return Performance.from_array(hits, result.performance.chokes)


def _note_limbs(score: Score, result: SessionResult) -> NDArray[np.int8]:
    return limbs_and_reasons(score, result.plan.kit)[0]


def _length_s(result: SessionResult, clock: TakeClock) -> float:
    """To the end of the last bar where they came so far, and of the last stroke."""
    last_ns = int(result.performance.hits["at_ns"].max(initial=0))
    last_s = (clock.lead_ns + last_ns) / NS_PER_S
    if result.complete and result.plan.click is not None:
        last_s = max(last_s, float(clock.seconds_at(result.plan.score.end_tick)))
    return last_s + RING_S


def _sound(soundtrack: Soundtrack, end_s: float) -> Iterator[Frames]:
    for until_s in np.arange(_BLOCK_S, end_s, _BLOCK_S).tolist():
        yield soundtrack.until(until_s)
    yield soundtrack.until(end_s)


def _remark(result: SessionResult, length_s: float) -> str:
    shown = f"These are the first {LONGEST_S / 60:g} minutes of it." if length_s > LONGEST_S else ""
    return " ".join(filter(None, (shown, extras_in_words(result))))
