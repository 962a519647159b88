"""All that a lesson can say as a form: a field for each key of the format.

In: a lesson's text and its faults. Out: fields with what stands there, and from what is typed the value for `SetKey`.
Made of the tables by which lessons are read, so that it knows every key that they do. First read `word_fields`.
"""
