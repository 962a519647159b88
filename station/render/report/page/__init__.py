"""A page about one session that stands alone: HTML for a browser, PDF for paper.

In: `SessionPage`, made by `station.scenes.report`. Out: text of a page, or bytes of a file.
`session_page` holds the facts, `engraved_bars` sets the practised bars, `charts` draws figures once for both;
`html_page` and `paper_page` put them on a page.
"""
