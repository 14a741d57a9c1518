"""Pictures as PNG, SVG or PDF files: results as curves and colour maps, and a scene at its start.

It uses `pen` for the drawing, `engine` for the assembled start and recorded runs, and `sweep` for writing
whole files.  Only the command line uses it.
"""
