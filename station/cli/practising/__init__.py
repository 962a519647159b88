"""What `practice` and `exam` are asked and do: options, the plan, a live session in the terminal, the report of it.

In: words of the command line, settings. Out: the session's outcome. First read `practice_options`, then `terminal`.
"""
