"""What of a battle lies over the picture: the page that covers it, or the board below it while somebody plays."""

from collections.abc import Callable

from station.app.actions.action import Action
from station.app.battle.battle_shown import BattleShown, BattleStage
from station.gui.panels.battle.battle_board import BOARD, board_height, draw_board
from station.gui.panels.battle.battle_result_page import BattleResultPage
from station.gui.panels.battle.battle_setup_page import BattleSetupPage
from station.gui.widgets.picture_box import bare_window, on_screen
from station.render.painter import Area

BATTLE = "Battle"


class BattleLayer:
    """The layer; what the user does in it goes to `dispatch`."""

    def __init__(self, dispatch: Callable[[Action], None]) -> None:
        self._setup, self._result = BattleSetupPage(dispatch), BattleResultPage(dispatch)

    def gui(self, shown: BattleShown, picture: Area, band: int) -> None:
        """Draw it over `picture`, the window's free middle, whose lowest `band` pixels are for what is chosen."""
        left, low, width, height = picture
        if shown.covers_picture:
            with bare_window(BATTLE, on_screen((left, low + band, width, height - band)), takes_keys=True):
                page = self._setup if shown.stage is BattleStage.CHOOSING else self._result
                page.gui(shown)
        elif band_of_board(shown, picture):
            box = on_screen((left, low, width, band_of_board(shown, picture)))
            with bare_window(BOARD, box):
                draw_board(shown.board, box, on_screen(picture).height)


def band_of_board(shown: BattleShown, picture: Area) -> int:
    """The pixels below `picture` that belong to the board; none where there is none."""
    return board_height(picture) if shown.stage is BattleStage.PLAYING else 0
