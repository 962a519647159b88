"""The window's panels, a module each; `page` says how one is docked and when it is shown."""
