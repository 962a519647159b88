"""All that can be asked of the controller, by mouse, keys or kit: plain values, a file for each part that takes them.

In: nothing. Out: `Action`, what `Controller.dispatch` takes. Read `action` first.
"""
