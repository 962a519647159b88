"""What `battle` is asked and does: options, rules, a live battle in the terminal, virtual players.

In: words of the command line, settings. Out: a battle's result. First read `battle_options`, then `battle_terminal`.
"""
