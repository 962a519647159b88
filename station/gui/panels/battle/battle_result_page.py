"""The page of a battle that is over: who won, round by round, and what the points of a round are made of."""

from collections.abc import Callable, Sequence

from imgui_bundle import imgui

from station.app.actions.action import Action
from station.app.actions.battle_actions import JudgeBattle
from station.app.battle.battle_shown import BattleResultShown, BattleShown, Evidence, RoundRow, Verdict
from station.core.short_names import short_paths
from station.gui import theme
from station.render import palette
from station.scoring.matching.hit_windows import Level

LEVEL_LABEL = "##battle-level"
_HEAD = 34.0
"""Letters of who won: read across a room."""
_TWO_COLUMNS = 620.0
"""Design pixels in which table and evidence stand beside each other (our choice)."""
_COLUMN = 240.0
"""Design pixels in which what one side was given can be read (our choice: six words a line)."""
_TABLE = 19.0
"""Letters of the table, a little larger than a panel's."""
_BAR = 8.0
"""Design pixels: how high the bar of a part's marks is."""


class BattleResultPage:
    """The page; what the user does goes to `dispatch`."""

    def __init__(self, dispatch: Callable[[Action], None]) -> None:
        self._dispatch = dispatch
        self._round = 0

    def gui(self, shown: BattleShown) -> None:
        """Draw the page and do what the user does in it."""
        result = shown.result
        if result is None:
            return
        theme.heading(result.headline, _HEAD)
        if imgui.get_content_region_avail().x < theme.points(_TWO_COLUMNS):
            self._rounds(result)
            self._evidence(result.rows)
            self._kept(result)
            return
        room, gap = imgui.get_content_region_avail(), imgui.get_style().item_spacing.x
        imgui.begin_child("##rounds", imgui.ImVec2((room.x - gap) * 0.45, 0))
        self._rounds(result)
        self._kept(result)
        imgui.end_child()
        imgui.same_line()
        imgui.begin_child("##evidence")
        self._evidence(result.rows)
        imgui.end_child()

    def _rounds(self, result: BattleResultShown) -> None:
        """A line a round; a press shows what it was made of."""
        heads = ("Round", *result.names)
        flags = imgui.TableFlags_.borders_inner_h | imgui.TableFlags_.sizing_stretch_prop
        if not imgui.begin_table("##battle-rounds", len(heads), flags):
            return
        imgui.push_font(None, _TABLE)
        for head in heads:
            imgui.table_setup_column(head)
        imgui.table_headers_row()
        for place, row in enumerate(result.rows):
            imgui.table_next_row()
            imgui.table_next_column()
            chosen = place == self._round
            if imgui.selectable(f"{row.title}##round{place}", chosen, imgui.SelectableFlags_.span_all_columns)[0]:
                self._round = place
            theme.tooltip("What the points are made of")
            for side, words in enumerate(row.given):
                imgui.table_next_column()
                theme.warning(words) if side in row.won_by else imgui.text_wrapped(words)
        imgui.pop_font()
        imgui.end_table()

    def _evidence(self, rows: Sequence[RoundRow]) -> None:
        if not rows:
            theme.soft("No round was played to its end.")
            return
        row = rows[min(self._round, len(rows) - 1)]
        theme.part(row.title)
        columns = len(row.verdicts)
        if columns < 2 or imgui.get_content_region_avail().x < columns * theme.points(_COLUMN):
            for verdict in row.verdicts:
                _verdict(verdict)
        elif imgui.begin_table("##verdicts", columns, imgui.TableFlags_.sizing_stretch_same):
            for verdict in row.verdicts:
                imgui.table_next_column()
                _verdict(verdict)
            imgui.end_table()

    def _kept(self, result: BattleResultShown) -> None:
        """What to practise, where it is kept, and how strictly it was judged."""
        for line in result.advice:
            imgui.text_wrapped(line)
        if result.judged_as is not None:
            self._level(result.judged_as)
        if result.told:
            theme.soft(result.told)
        if result.folder:
            theme.soft(f"Kept in {short_paths(result.folder)}")

    def _level(self, judged_as: Level) -> None:
        """The list that chooses by which windows the battle is judged again."""
        imgui.set_next_item_width(-1)
        if not imgui.begin_combo(LEVEL_LABEL, f"judged as {judged_as.words}"):
            theme.tooltip("Judge it again from what was recorded, more strictly or less; what is kept stays")
            return
        for each in Level:
            if imgui.selectable(f"{each.words}###{each}", each is judged_as)[0] and each is not judged_as:
                self._dispatch(JudgeBattle(each))
            theme.tooltip(f"Right is within {each.on_time_ms:g} ms")
        imgui.end_combo()


def _verdict(verdict: Verdict) -> None:
    theme.heading(f"{verdict.side}: {verdict.points}", 20)
    for each in verdict.evidence:
        _part(each)


def _part(evidence: Evidence) -> None:
    """A part of the points: what it is, its marks as a bar, what was seen."""
    if evidence.marks is None:
        theme.soft(evidence.words or f"{evidence.title}: there was nothing to judge")
        return
    imgui.text_wrapped(f"{evidence.title}: {evidence.marks:.0f}")
    at, wide, high = imgui.get_cursor_screen_pos(), imgui.get_content_region_avail().x, theme.points(_BAR)
    brush = imgui.get_window_draw_list()
    for share, colour in ((1.0, palette.with_opacity(palette.INK, 0.12)), (evidence.marks / 100, palette.GOOD)):
        right = imgui.ImVec2(at.x + max(share * wide, 1.0), at.y + high)
        brush.add_rect_filled(at, right, theme.packed(colour), high / 2)
    imgui.dummy(imgui.ImVec2(wide, high))
    if evidence.words:
        theme.soft(evidence.words)
