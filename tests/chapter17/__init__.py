"""The scenes of studies/chapter17: figures derived elsewhere, other routes, other observers; the gallery."""
