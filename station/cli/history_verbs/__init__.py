"""The verbs of `station history`, a file each: what is kept, taken away, deleted and copied."""
