"""The tests in Python, in folders as the rooms of the package; those in C are in kernel/."""

from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
STUDIES = ROOT / "studies"
CHAPTER = STUDIES / "chapter17"
