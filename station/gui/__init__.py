"""The window: imgui and nothing else.

In: the view of `app.controller`, once a frame. Out: pictures on the screen, and actions for the controller.
`window` is the frame's order, `window_frame` and `panel_layout` say which panels there are, `viewport` draws the scene
behind them, `theme` has the colours, `panels` a module a panel.
Read `window` first.
"""
