"""The window as hello_imgui needs it: its size, OpenGL, where panels dock, and which part the picture keeps."""

import os
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from imgui_bundle import hello_imgui, imgui

from station.gui import theme
from station.gui.display import Screen
from station.gui.glfw_screen import glfw_screen
from station.gui.panel_size import Size
from station.gui.panels.panel import DockSide
from station.render.painter import Area
from station.render.snapshot import Snapshot

TITLE = "Drum station"
_LAYOUT_FOLDER = hello_imgui.IniFolderType.app_user_config_folder
_DOCK = "MainDockSpace"
_SPLITS = (
    (DockSide.BELOW, imgui.Dir.down, 0.28, 0.56),
    (DockSide.BESIDE, imgui.Dir.left, 0.26, 0.45),
    (DockSide.RIGHT, imgui.Dir.right, 0.42, 0.62),
    (DockSide.STRIP, imgui.Dir.down, 0.5, 0.72),
    (DockSide.EDITOR, imgui.Dir.down, 0.7, 0.8),
)
"""Where panels dock, in this order: side, way, their share of what is left, and the most of it when they are large."""
_WITHOUT_TABS = (DockSide.BELOW, DockSide.EDITOR, DockSide.BESIDE)
"""Where one panel stands alone."""


@dataclass(frozen=True, slots=True)
class WindowOptions:
    """How the window opens: `size` in pixels, `quality` 0–2 or None to measure, whether the layout is remembered.

    `tests` registers tests with imgui's test engine
    and makes it run, without a pause between frames; `picture_every` draws the picture in every so manieth frame alone
    and leaves it dark between them, for whoever watches the panels. `shown` is called whenever a frame is on the
    screen, with what it shows behind the panels; the window closes when it says no. `screen` is asked for the monitors
    once the window is open: None where windows cannot be placed. `opens` names a file that is taken in as if it were
    dropped, empty for none.
    """

    size: tuple[int, int] = (1280, 720)
    quality: int | None = None
    remember_layout: bool = True
    tests: Callable[[], None] | None = None
    picture_every: int = 1
    shown: Callable[[Snapshot | None], bool] | None = None
    screen: Callable[[], Screen | None] = glfw_screen
    opens: str = ""


@dataclass(frozen=True, slots=True)
class Calls:
    """What is done when the window has `opened`, in a frame (`before`, `picture`, gui `over`, `swapped`), at last."""

    opened: Callable[[], None]
    before: Callable[[], None]
    picture: Callable[[], None]
    over: Callable[[], None]
    swapped: Callable[[], None]
    leaving: Callable[[], None]


def runner(
    options: WindowOptions, calls: Calls, windows: Sequence[hello_imgui.DockableWindow], shares: Size
) -> hello_imgui.RunnerParams:
    """What hello_imgui runs: a window with `windows` docked in it, in places as large as `splits` makes them."""
    params = hello_imgui.RunnerParams()
    params.app_window_params.window_title = TITLE
    params.app_window_params.window_geometry.size = options.size
    params.app_window_params.restore_previous_geometry = options.remember_layout
    imgui_window = params.imgui_window_params
    imgui_window.default_imgui_window_type = hello_imgui.DefaultImGuiWindowType.provide_full_screen_dock_space
    imgui_window.enable_viewports = False
    imgui_window.show_menu_bar = imgui_window.show_status_bar = False
    params.ini_disable = not (options.remember_layout and _has_layout_folder())
    params.ini_folder_type = _LAYOUT_FOLDER
    params.fps_idling.fps_idle = 20.0
    _use_opengl_3_3(params)
    callbacks = params.callbacks
    callbacks.load_additional_fonts = theme.load_fonts
    callbacks.setup_imgui_style = theme.apply
    callbacks.post_init = calls.opened
    callbacks.custom_background = calls.picture
    callbacks.pre_new_frame = calls.before
    callbacks.show_gui = calls.over
    callbacks.before_exit = calls.leaving
    callbacks.after_swap = calls.swapped
    docking = params.docking_params
    docking.layout_condition = hello_imgui.DockingLayoutCondition.application_start
    docking.docking_splits = splits(shares)
    docking.dockable_windows = [*windows]
    if options.tests is not None:
        params.use_imgui_test_engine = True
        params.fps_idling.fps_idle = 0.0
        callbacks.register_tests = options.tests
    return params


def _has_layout_folder() -> bool:
    """Whether there is a folder that the layout can be kept in: hello_imgui opens no window without."""
    folder = Path(hello_imgui.ini_folder_location(_LAYOUT_FOLDER))
    with suppress(OSError):
        folder.mkdir(parents=True, exist_ok=True)
    return folder.is_dir() and os.access(folder, os.W_OK | os.X_OK)


def _use_opengl_3_3(params: hello_imgui.RunnerParams) -> None:
    gl = hello_imgui.OpenGlOptions()
    gl.glsl_version, gl.major_version, gl.minor_version = "330", 3, 3
    gl.use_core_profile = gl.use_forward_compat = True
    gl.anti_aliasing_samples = 0  # the picture smooths itself, off screen
    params.renderer_backend_options.open_gl_options = gl


def splits(shares: Size) -> list[hello_imgui.DockingSplit]:
    """Where panels dock; the larger they are, the more of the window they take (`panel_size.shares`)."""
    grown = {imgui.Dir.left: shares[0], imgui.Dir.right: shares[0], imgui.Dir.down: shares[1]}
    made = [
        hello_imgui.DockingSplit(_DOCK, str(side), way, min(share * grown[way], most))
        for side, way, share, most in _SPLITS
    ]
    for split in (split for split in made if split.new_dock in _WITHOUT_TABS):
        split.node_flags = imgui.DockNodeFlags_.auto_hide_tab_bar
    return made


def logical_size() -> Size | None:
    """The window's size in logical pixels (`panel_size`); None before there is one."""
    width, height = imgui.get_io().display_size
    density = float(hello_imgui.dpi_window_size_factor())
    return (width / density, height / density) if min(width, height) > 1.0 and density > 0.0 else None


def central_area(docking: hello_imgui.DockingParams) -> Area:
    """The free middle of the window in the screen's pixels, from the lower left corner."""
    io = imgui.get_io()
    sx, sy = io.display_framebuffer_scale
    width, height = io.display_size
    dock = docking.dock_space_id_from_name(_DOCK)
    node = imgui.internal.dock_builder_get_central_node(dock) if dock is not None else None
    if node is None:
        return (0, 0, round(width * sx), round(height * sy))
    low = height - node.pos.y - node.size.y
    return (round(node.pos.x * sx), round(low * sy), round(node.size.x * sx), round(node.size.y * sy))
