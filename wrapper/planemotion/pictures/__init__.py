"""Pictures as PNG, SVG or PDF files: results as curves and colour maps, a scene at any instant, and the
figures of the book.

`acting` knows what acts on each body, `diagrams` draws it, `energies` draws work.  It uses `pen` for the
drawing, `compile` for what is recorded, `engine` for the assembled start and recorded runs, and `sweep` for
writing whole files.  The command line, Scene.draw and `animation` use it.
"""
