"""Options as data: a frozen dataclass a command, read by argparse at the edge; those that several commands share.

In: words of the shell. Out: typed values. `option_fields` says what an option is.
"""
