"""The demonstrator's style as the window sets it: controls with their words, values, the styles there are.

In: a style. Out: the same with a control moved. `style_controls` is the table of controls, `style_options` what is
set, `style_library` the styles that ship and the user's own.
Read `style_controls` first.
"""
