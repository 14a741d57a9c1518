"""What everything may raise, files, versions of what computes, and tables for a notebook.

This room uses nothing but the standard library and the compiled kernel's own version.  Every room uses it.
"""
