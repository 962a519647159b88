"""From where the window looks: the user's view, and the lesson's while it asks for one."""

from station.app.settings.view_settings import ViewSettings
from station.core.named_view import NamedView
from station.gui.viewport import Viewport
from station.render.framing import named

FRONT = ViewSettings(view=NamedView.FRONT)


def test_the_lesson_s_view_is_gone_to_once_and_left_when_it_asks_no_more() -> None:
    viewport = Viewport(0, FRONT)
    viewport.follow(FRONT, NamedView.FEET)
    assert viewport.camera == named(NamedView.FEET)
    viewport.camera = turned = viewport.camera.orbited(0.3, 0.1)
    viewport.follow(FRONT, NamedView.FEET)
    assert viewport.camera == turned
    viewport.follow(FRONT, NamedView.HANDS)
    assert viewport.camera == named(NamedView.HANDS)
    viewport.follow(FRONT)
    assert viewport.camera == named(NamedView.FRONT)


def test_a_view_that_the_user_takes_meanwhile_stays_until_the_lesson_asks_for_another() -> None:
    viewport = Viewport(0, FRONT)
    viewport.follow(FRONT, NamedView.FEET)
    top = ViewSettings(view=NamedView.TOP, mirrored=True)
    viewport.follow(top, NamedView.FEET)
    assert (viewport.camera.target, viewport.camera.mirrored) == (named(NamedView.TOP).target, True)
