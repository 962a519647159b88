"""An assessment in words, as JSON and as a table of pairs.

In: a `Summary`. Out: the assessment document, advice in sentences, `pairs.csv`.
`advice` has the sentences, `assessment_document` the JSON, `technique_text` technique in words.
Read `assessment_document` first.
"""
