"""What `station animate` writes: its options, motions as numbers, pictures and films.

In: options of the command and a score. Out: a file whose ending says its kind.
Read `animate_options` first.
"""
