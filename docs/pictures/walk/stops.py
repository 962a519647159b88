"""The stops of the hour, in their order: what a new user does, and what they look at then."""

from collections.abc import Callable
from dataclasses import replace
from time import monotonic

from imgui_bundle import imgui
from pty_student import CRASH, FLOOR_TOM, HIHAT, KICK, SNARE, TOM_1, Playing
from real_room import Context, RealRoom

from station.app.actions.practice_actions import Dismiss, EndSession
from station.app.actions.settings_actions import SetPreferences, SetView
from station.app.room_state import Stage
from station.app.sessions.who_plays import QUESTION
from station.app.window_state import State
from station.gui.panels.choice_panel import CHOICE, label_of
from station.gui.panels.devices.devices_panel import DEVICES
from station.gui.panels.lessons.who_plays import NEW_NAME, WHO_LABEL
from station.gui.panels.playback_row import PREVIOUS_LABEL, STUDENT_LABEL
from station.gui.panels.practice_panel import PRACTICE
from station.gui.panels.sound.sound_panel import CLICK_TAB, DRUMS_TAB, LEVELS_TAB, OUTPUT_TAB, SOUND, TABS
from station.gui.panels.today_panel import TODAY
from station.gui.panels.view_popup import LOOK_LABEL
from station.render.notation.screen.score_place import ScoreForm
from tests.gui.drive import open_panel, press_view, to_edit, to_list, to_options

Stop = Callable[[RealRoom, Context], None]
LATE_MS = 87.0
"""How late the unmeasured equipment is."""
BEAT_MS = 60_000 / 84
"""A beat of `rock-2`."""
JUDGED = 8


def judged(state: State) -> bool:
    """Whether a few strokes of this pass are judged."""
    return state.snapshot is not None and state.snapshot.hud.judged >= JUDGED


def practise(room: RealRoom, ctx: Context, playing: Playing, lesson: str = "rock-2", passes: int = 1) -> None:
    """Choose a lesson, and begin it."""
    home(room, ctx)
    room.student.playing = playing
    to_list(ctx)
    ctx.item_input_value("##search", "Rock 2")
    ctx.item_click(f"**/###{lesson}")
    to_options(ctx)
    if room.state.selection.adapt:
        ctx.item_click("**/the tempo follows me")
    ctx.item_input_value("##passes", passes)
    ctx.yield_(3)
    ctx.set_ref("//Lessons")
    ctx.item_click("**/Start##start")


def home(room: RealRoom, ctx: Context) -> None:
    """Back to the lessons, with no panel open."""
    ctx.popup_close_all()
    room.station.dispatch(EndSession())
    room.station.dispatch(Dismiss())
    ctx.yield_(3)
    for page in room.window.pages.tools:
        room.window.params.docking_params.dockable_window_of_name(page.name).is_visible = False
    ctx.yield_(3)


def wait(ctx: Context, seconds: float) -> None:
    """Let frames pass for so long by the clock; the test engine's own pause takes no time."""
    until = monotonic() + seconds
    while monotonic() < until:
        ctx.yield_()


def heard(room: RealRoom, ctx: Context) -> None:
    """Let frames pass until a pad may choose from what is on the screen."""
    room.wait_until(ctx, lambda state: state.choice is not None and state.choice.hears)
    ctx.yield_(3)


def show_score(room: RealRoom, form: ScoreForm) -> None:
    """Another form of the score."""
    room.station.dispatch(SetView(replace(room.state.view_settings, score=form)))


# --- the first minute -------------------------------------------------------------------------------------------------


def first_start(room: RealRoom, ctx: Context) -> None:
    """The questions before anything else."""
    ctx.yield_(3)
    ctx.key_chars("Ann")


def first_groove(room: RealRoom, ctx: Context) -> None:
    """The drummer plays it; the kit and the sound card are nobody's yet, and late."""
    room.student.playing = Playing(lag_ms=LATE_MS)
    ctx.item_click("//Welcome/**/###begin")
    room.wait_until(ctx, lambda state: "Demonstration" in room.picture.hud.phase)
    ctx.yield_(20)


def counted_in(room: RealRoom, ctx: Context) -> None:
    """One's own turn."""
    room.wait_until(ctx, lambda state: state.snapshot is not None and state.snapshot.hud.count_in == 3)


def first_pass(room: RealRoom, ctx: Context) -> None:
    """Somebody plays along."""
    room.wait_until(ctx, judged)


def lag_found(room: RealRoom, ctx: Context) -> None:
    """What they are told: it was the equipment."""
    room.wait_until(ctx, lambda state: state.room.stage is Stage.RESULT)
    ctx.yield_(10)


def lag_taken_out(room: RealRoom, ctx: Context) -> None:
    """One click takes it out; what to do next."""
    ctx.item_click(f"//{CHOICE}/{label_of(0)}")
    ctx.yield_(10)


# --- a drill, and what comes after it ---------------------------------------------------------------------------------


def lesson(room: RealRoom, ctx: Context) -> None:
    """The list of lessons."""
    home(room, ctx)
    ctx.yield_(40)


def question(room: RealRoom, ctx: Context) -> None:
    """Whether they rushed, dragged, or were on."""
    practise(room, ctx, Playing("beginner,seed=3,bias_ms=-25", LATE_MS))
    room.wait_until(ctx, lambda state: state.room.stage is Stage.RESULT)
    heard(room, ctx)


def next_steps(room: RealRoom, ctx: Context) -> None:
    """Answered on a pad: the result, and what comes next on buttons."""
    room.student.strike(SNARE)
    room.wait_until(ctx, lambda state: not state.room.question and state.report is not None)
    heard(room, ctx)


def step_by_pad(room: RealRoom, ctx: Context) -> None:
    """The best one, by its pad."""
    room.student.playing = Playing("intermediate,seed=5", LATE_MS)
    room.student.strike(SNARE)
    room.wait_until(ctx, lambda state: state.room.stage is Stage.PLAYING)
    room.wait_until(ctx, lambda state: state.snapshot is not None and state.snapshot.hud.count_in is not None)


def tempo_follows(room: RealRoom, ctx: Context) -> None:
    """Which pass, and the tempo now, at first, and aimed at."""
    home(room, ctx)
    room.student.playing = Playing("pro,seed=6", LATE_MS)
    to_list(ctx)
    ctx.item_input_value("##search", "Rock 1")
    ctx.item_click("**/###rock-1")
    to_options(ctx)
    if not room.state.selection.adapt:
        ctx.item_click("**/the tempo follows me")
    ctx.yield_(3)
    ctx.set_ref("//Lessons")
    ctx.item_click("**/Start##start")
    room.wait_until(ctx, lambda state: "ass 2" in room.picture.hud.phase)
    room.wait_until(ctx, judged)


def paused(room: RealRoom, ctx: Context) -> None:
    """They stop in the middle, and the score waits."""
    practise(room, ctx, Playing("intermediate,seed=4", LATE_MS, stops=1), passes=4)
    room.wait_until(ctx, lambda state: state.room.paused)
    ctx.yield_(10)


def goes_on(room: RealRoom, ctx: Context) -> None:
    """Two kicks, a bar of count-in, and on."""
    wait(ctx, 2.5)
    room.student.strike(KICK, KICK, apart_s=0.4)
    room.wait_until(ctx, lambda state: not state.room.paused)
    room.wait_until(ctx, lambda state: state.snapshot is not None and state.snapshot.hud.count_in is None)
    room.wait_until(ctx, judged)
    wait(ctx, 2.0)


def late_entry(room: RealRoom, ctx: Context) -> None:
    """They come in a beat late and play on."""
    room.station.dispatch(SetPreferences(replace(room.state.preferences, ask_first=False)))
    practise(room, ctx, Playing("intermediate,seed=8", LATE_MS + BEAT_MS), passes=2)
    room.wait_until(ctx, lambda state: state.room.stage is Stage.RESULT)
    ctx.yield_(10)


def replayed(room: RealRoom, ctx: Context) -> None:
    """A bar of it again: what was played stands on the staff."""
    practise(room, ctx, Playing("beginner,seed=11", LATE_MS), passes=1)
    room.wait_until(ctx, lambda state: state.room.stage is Stage.RESULT)
    ctx.yield_(5)
    ctx.set_ref("//Bars")
    ctx.item_click(f"**/{STUDENT_LABEL}")
    wait(ctx, 1.2)


def compared(room: RealRoom, ctx: Context) -> None:
    """The same bar in an earlier session."""
    room.wait_until(ctx, lambda state: not state.room.listening)
    ctx.set_ref("//Bars")
    ctx.item_click(f"**/{PREVIOUS_LABEL}")
    wait(ctx, 1.2)


# --- reading ----------------------------------------------------------------------------------------------------------


def scrolling(room: RealRoom, ctx: Context) -> None:
    """The score that rolls by."""
    show_score(room, ScoreForm.SCROLLING)
    practise(room, ctx, Playing("intermediate,seed=4", LATE_MS), passes=4)
    room.wait_until(ctx, judged)


def highway(room: RealRoom, ctx: Context) -> None:
    """A lane for every piece."""
    show_score(room, ScoreForm.HIGHWAY)
    wait(ctx, 2.0)


def falling(room: RealRoom, ctx: Context) -> None:
    """The same upright."""
    show_score(room, ScoreForm.FALLING)
    wait(ctx, 2.0)


def just_play(room: RealRoom, ctx: Context) -> None:
    """No lesson at all."""
    show_score(room, ScoreForm.PAGED)
    home(room, ctx)
    to_list(ctx)
    ctx.item_input_value("##search", "")
    ctx.item_click("**/Just play##free")
    ctx.yield_(3)
    ctx.set_ref("//Lessons")
    ctx.item_click("**/Start##start")
    room.wait_until(ctx, lambda state: state.room.stage is Stage.PLAYING)
    room.student.strike(KICK, HIHAT, SNARE, HIHAT, KICK, TOM_1, FLOOR_TOM, CRASH, apart_s=0.3)
    wait(ctx, 2.6)


# --- within reach -----------------------------------------------------------------------------------------------------


def _sound(leaf: str) -> Stop:
    def show(room: RealRoom, ctx: Context) -> None:
        home(room, ctx)
        open_panel(ctx, SOUND)
        if room.window.pages.sound.leaf != leaf:
            ctx.item_click(f"//{SOUND}/{TABS}/{leaf}")
        wait(ctx, 1.0)

    show.__name__ = f"sound_{leaf.lower()}"
    return show


def who_plays(room: RealRoom, ctx: Context) -> None:
    """Two at one kit: the list, by mouse or by pad."""
    home(room, ctx)
    ctx.set_ref("//Lessons")
    ctx.item_click(f"**/{WHO_LABEL}")
    ctx.yield_(5)
    ctx.set_ref(f"//{QUESTION}")
    ctx.item_input_value(NEW_NAME, "Bea")
    room.wait_until(ctx, lambda state: not state.students.asks)
    ctx.set_ref("//Lessons")
    ctx.item_click(f"**/{WHO_LABEL}")
    room.wait_until(ctx, lambda state: state.students.hears)
    ctx.yield_(3)


def chosen_by_pad(room: RealRoom, ctx: Context) -> None:
    """A pad lets the first one play again."""
    room.student.strike(TOM_1)
    room.wait_until(ctx, lambda state: not state.students.asks)
    ctx.yield_(5)


def _panel(name: str) -> Stop:
    def show(room: RealRoom, ctx: Context) -> None:
        home(room, ctx)
        open_panel(ctx, name)
        wait(ctx, 1.0)

    show.__name__ = name.lower()
    return show


def devices(room: RealRoom, ctx: Context) -> None:
    """What the kit sends."""
    _panel(DEVICES)(room, ctx)
    room.student.strike(SNARE, HIHAT, TOM_1, KICK, SNARE, HIHAT, apart_s=0.25)
    wait(ctx, 2.0)


def look(room: RealRoom, ctx: Context) -> None:
    """How it may look."""
    home(room, ctx)
    press_view(ctx, LOOK_LABEL)
    ctx.yield_(5)


def help_page(room: RealRoom, ctx: Context) -> None:
    """F1."""
    home(room, ctx)
    ctx.key_press(imgui.Key.f1)
    ctx.yield_(5)


def help_keys(room: RealRoom, ctx: Context) -> None:
    """Its keys."""
    ctx.item_click("//Help/**/Keys")
    ctx.yield_(5)


def course(room: RealRoom, ctx: Context) -> None:
    """Lessons in a teacher's order."""
    ctx.key_press(imgui.Key.f1)
    home(room, ctx)
    to_list(ctx)
    ctx.item_click("##course")
    ctx.item_click("//$FOCUSED/###course-first-beats")
    ctx.yield_(5)


def editor(room: RealRoom, ctx: Context) -> None:
    """A lesson of one's own."""
    to_edit(ctx)
    ctx.item_click("**/Edit##edit-lesson")
    ctx.yield_(20)


STOPS: tuple[Stop, ...] = (
    first_start,
    first_groove,
    counted_in,
    first_pass,
    lag_found,
    lag_taken_out,
    lesson,
    question,
    next_steps,
    step_by_pad,
    tempo_follows,
    paused,
    goes_on,
    late_entry,
    replayed,
    compared,
    scrolling,
    highway,
    falling,
    just_play,
    _sound(CLICK_TAB),
    _sound(LEVELS_TAB),
    _sound(DRUMS_TAB),
    _sound(OUTPUT_TAB),
    who_plays,
    chosen_by_pad,
    devices,
    _panel(TODAY),
    _panel(PRACTICE),
    look,
    help_page,
    help_keys,
    course,
    editor,
)
