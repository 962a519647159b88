"""Who the drummer of a battle can be: six characters, from a pocket player to one who mirrors the student.

In: a name. Out: an `Opponent`: how it moves, what it plays on, how bold, dense and loud it is, what it gets wrong, and
out of which lessons its vocabulary comes. Read `opponent`.
"""
