"""The command line: a file a command, each imported only when it runs.

In: words of the shell. Out: text or one JSON document on standard output, faults in one line on standard error.
`command_line` has the table of commands, `console` prints, `options` and `input` are shared by several commands.
Read `command_line` first, then the file of the command: `station lesson` is `lesson`.
"""
