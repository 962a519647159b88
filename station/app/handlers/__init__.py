"""What an action does that concerns several parts of the station; a part that it concerns alone takes it itself.

In: the station's parts and an action. Out: parts that have changed, and a line for the user where there is one to say.
A handler raises `StationError` where it cannot be done. Read `handler_table` first: a row a kind of action.
"""
