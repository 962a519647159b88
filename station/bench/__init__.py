"""The benchmarks of `station bench`."""
