"""The sticks panel: each sensor with its stick, live; which hand holds it; the mounting gesture; playing in the air."""

from collections.abc import Callable
from math import degrees

from imgui_bundle import imgui

from station.app.actions.action import Action
from station.app.actions.equipment_actions import (
    FollowPhase,
    GiveUpSticks,
    LearnAir,
    LearnMounting,
    LookForSticks,
    PlayInAir,
    SetHand,
    SoundPhase,
)
from station.app.equipment.sticks_view import Lesson, SticksView, StickView
from station.app.room_state import Stage
from station.app.window_state import State
from station.core.events import PhaseEstimate
from station.core.labels import piece_name
from station.core.pieces import Limb
from station.gui import theme
from station.gui.widgets.stick_drawing import draw_sticks

STICKS = "Sticks"
ABOUT = "Sensors on the sticks: how they do, which hand holds which, drumming in the air"
HELP = (
    "A motion sensor on each stick tells which hand struck, how fast and from how high. Make the mounting gesture once"
    " after you have put a sensor on: it says how the sensor sits and which hand holds it. In the air the sticks play"
    " pads that are not there: learn in a minute where each of them shall be. Feet have no sensors: a pedal, a foot"
    " switch or a key plays the kick."
)
GESTURE_LABEL, AIR_LABEL, GIVE_UP_LABEL = "Mounting gesture##sticks", "Learn the air kit##sticks", "Give up##sticks"
PLAY_AIR_LABEL, FOLLOW_LABEL = "play in the air", "follow my phase"
SOUND_LABEL = "sound my phase"
PORTS_LABEL, LOOK_LABEL = "##stick-ports", "Look there##sticks"
_NO_STICKS = "No sensor is here."
_HOW = "Plug one in or switch it on, and say below where it is: docs/sensors.md has the sensors that are understood."
_PORTS_HINT = "serial:PATH@BAUD; ble:NAME"
_LONGEST_PORTS = 400
"""Letters; our choice: two paths and more."""
_PICTURE_HIGH = 170.0
_HANDS = ((Limb.LEFT_HAND, "left"), (Limb.RIGHT_HAND, "right"))
_HAND_NAMES = dict(_HANDS)
_SEATS = {Limb.LEFT_HAND: 0, Limb.UNKNOWN: 1, Limb.RIGHT_HAND: 2}
"""From left to right, as the player sees their own hands."""


class SticksPanel:
    """The panel; what the user does goes to `dispatch`."""

    def __init__(self, dispatch: Callable[[Action], None]) -> None:
        self._dispatch = dispatch
        self._ports: str | None = None
        """What is typed, None while nobody has."""

    def gui(self, state: State) -> None:
        """Draw the panel and do what the user does in it; nothing is learnt while somebody plays."""
        view, may_learn = state.sticks, state.room.stage is not Stage.PLAYING
        if not view.sticks:
            theme.heading(_NO_STICKS)
            theme.soft(_HOW)
            self._where(state.settings.sticks, may_learn)
            return
        sticks = sorted(view.sticks, key=lambda stick: _SEATS.get(stick.limb, 1))
        size = imgui.get_content_region_avail().x, theme.points(_PICTURE_HIGH)
        draw_sticks([(_HAND_NAMES.get(stick.limb, "which hand?"), stick.turn) for stick in sticks], size)
        theme.tooltip(
            "Your sticks, as you hold them; what points ahead for long is ahead. The bright face is the sensor"
        )
        if view.lesson is not None:
            self._lesson(view.lesson)
            return
        for stick in sticks:
            self._stick(stick, may_learn)
        self._gesture(view, may_learn)
        self._air(view, may_learn)
        self._phase(view)
        self._where(state.settings.sticks, may_learn)

    def _stick(self, stick: StickView, may_learn: bool) -> None:
        imgui.separator_text(theme.one_line(stick.device, imgui.get_content_region_avail().x - theme.points(30)))
        imgui.begin_disabled(not may_learn)
        for limb, label in _HANDS:
            if imgui.radio_button(f"{label}##{stick.device}", stick.limb is limb) and stick.limb is not limb:
                self._dispatch(SetHand(stick.device, limb))
            theme.tooltip(f"This stick is in the {label} hand")
            imgui.same_line()
        imgui.end_disabled()
        imgui.align_text_to_frame_padding()
        theme.soft({True: "moves", False: "lies still", None: ""}[stick.moves])
        theme.soft(", ".join(stick.facts))
        for trouble in stick.troubles:
            imgui.text_wrapped(trouble)
        if stick.limb is Limb.UNKNOWN:
            theme.soft("Which hand holds it is not known: make the mounting gesture, or choose left or right.")
        elif not stick.is_learnt:
            theme.soft("How it sits on the stick is assumed: make the mounting gesture.")

    def _gesture(self, view: SticksView, may_learn: bool) -> None:
        imgui.spacing()
        imgui.begin_disabled(not may_learn)
        if imgui.button(GESTURE_LABEL, imgui.ImVec2(-1, theme.points(38))):
            self._dispatch(LearnMounting())
        imgui.end_disabled()
        theme.tooltip("Ten seconds: lay both sticks on the drum, then four taps right and four left")
        for line in view.learnt:
            imgui.text_wrapped(line)

    def _air(self, view: SticksView, may_learn: bool) -> None:
        imgui.separator_text("In the air")
        imgui.begin_disabled(not view.zones)
        changed, on = theme.checkbox(PLAY_AIR_LABEL, view.plays_air and bool(view.zones))
        imgui.end_disabled()
        theme.tooltip("Strokes in the air are hits; a piece whose pad you strike sounds by its pad alone from then on")
        if changed:
            self._dispatch(PlayInAir(on))
        theme.soft(_zones_in_words(view))
        imgui.begin_disabled(not may_learn)
        if imgui.button(AIR_LABEL, imgui.ImVec2(-1, theme.points(38))):
            self._dispatch(LearnAir())
        imgui.end_disabled()
        theme.tooltip("Strike each piece eight times where you want it to be: half a minute")

    def _phase(self, view: SticksView) -> None:
        imgui.separator_text("Phase")
        changed, on = theme.checkbox(FOLLOW_LABEL, view.follows_phase)
        theme.tooltip("The demonstration goes by where your sticks are in the loop, not by the clock")
        if changed:
            self._dispatch(FollowPhase(on))
        imgui.begin_disabled(not view.follows_phase)
        changed, on = theme.checkbox(SOUND_LABEL, view.sounds_phase and view.follows_phase)
        imgui.end_disabled()
        theme.tooltip("Each stroke of the drill sounds as your phase passes it; nothing that sounds so is judged")
        if changed:
            self._dispatch(SoundPhase(on))
        if view.phase is not None:
            theme.soft(_phase_in_words(view.phase))

    def _where(self, ports: str, may_look: bool) -> None:
        """The ports that are listened to, and others that the user types."""
        imgui.separator_text("Where they are")
        typed = ports if self._ports is None else self._ports
        imgui.set_next_item_width(-1)
        _, typed = imgui.input_text_with_hint(PORTS_LABEL, _PORTS_HINT, typed[:_LONGEST_PORTS])
        theme.tooltip("serial:PATH@BAUD, part of an adapter's name, or ble:NAME; a semicolon between two sensors")
        self._ports = None if typed == ports else typed
        imgui.begin_disabled(not may_look or typed == ports)
        if imgui.button(LOOK_LABEL, imgui.ImVec2(-1, theme.points(38))):
            self._dispatch(LookForSticks(typed))
        imgui.end_disabled()
        theme.tooltip("Listen there from now on: sound and kits are silent for a moment")

    def _lesson(self, lesson: Lesson) -> None:
        imgui.spacing()
        theme.heading(lesson.asks, 20)
        imgui.progress_bar(lesson.done, imgui.ImVec2(-1, theme.points(10)), "")
        imgui.spacing()
        if imgui.button(GIVE_UP_LABEL, imgui.ImVec2(-1, theme.points(38))):
            self._dispatch(GiveUpSticks())
        theme.tooltip("Esc, too; nothing changes")


def _zones_in_words(view: SticksView) -> str:
    """What each hand's zones are."""
    if not view.zones:
        return "No zones are learnt yet."
    said = [
        f"{label}: {', '.join(piece_name(zone.piece) for zone in view.zones if zone.limb is limb)}"
        for limb, label in _HANDS
        if any(zone.limb is limb for zone in view.zones)
    ]
    return "; ".join(said)


def _phase_in_words(phase: PhaseEstimate) -> str:
    """Where in the loop the sticks are, as far as anybody knows."""
    if not phase.locked:
        return "not found yet: play the loop"
    return f"found: {degrees(phase.phase_rad):.0f}° of the loop, {phase.confidence:.0%} sure"
