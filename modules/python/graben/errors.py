"""The exceptions graben raises, beside ValueError and TypeError for arguments that are not what they should be."""

from typing import Optional


class Error(Exception):
    """Base of every error that graben itself raises.

    Attributes
    ----------
    file : str or None
        The file it is about.
    row : int or None
        The row in that file, counted from 1.
    """

    def __init__(self, message: str, file: Optional[str] = None, row: Optional[int] = None):
        super().__init__(message)
        self.file = file
        self.row = row

    def __reduce__(self):
        return type(self), (str(self), self.file, self.row)


class FileError(Error, OSError):
    """A file cannot be read or written, or does not hold what it should; see the attributes file and row."""

    def __str__(self) -> str:
        return str(self.args[0])


class InvalidInputError(Error, ValueError):
    """Picks, faults or options cannot be used as they are: too few picks, all on a line, an option out of its range."""


class ResourceError(Error, MemoryError):
    """The job needs more memory than it may take; the message names what would fit."""
