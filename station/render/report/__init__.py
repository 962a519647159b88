"""The result of a session as a page: plots of strokes, cards, what to do next.

In: `ResultFacts`. Out: flat shapes, or a PNG file.
`stroke_plot` says what a plot of strokes looks like wherever one is drawn, `report_cards` draws the cards,
`report_layout` places them.
Read `report_picture` first.
"""
