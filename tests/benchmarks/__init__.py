"""The benchmark and the named studies."""
