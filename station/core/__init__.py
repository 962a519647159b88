"""The words of the drum station: pieces, hits, time, errors, settings. Imports nothing of ours."""
