"""The commands of the command line, a module each: `add_options(parser)` and `run(arguments) -> exit status`."""
