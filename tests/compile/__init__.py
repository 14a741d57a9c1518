"""Scenes as tables of the kernel."""
