"""How the drummer moves: the controls of expression, over the bars, and the files of styles.

In: a style's TOML file, or sliders. Out: a `Style`.
`style` has the controls, `automation_lanes` lets them change over the bars, `proposal` proposes one from the score.
A new style is a file in `motion/data/styles`. Read `style` first.
"""
