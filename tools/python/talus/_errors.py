"""Errors of the input."""

import os


class ScenarioError(ValueError):
    """All faults found in a model, a file or an argument.

    errors: list of (file, line, column, field, message); file, line and column are None where unknown.
    """

    def __init__(self, errors):
        self.errors = list(errors)
        super().__init__("\n".join(_line(error) for error in self.errors))

    def __reduce__(self):
        return type(self), (self.errors,)


def path_of(file):
    """A path as text. Raises ScenarioError for a path with a NUL character, where the system would cut it."""
    path = os.fspath(file)
    if ("\0" if isinstance(path, str) else b"\0") in path:
        raise ScenarioError([(None, None, None, "", f"found the path {path!r}, allowed: one without NUL characters")])
    return path


def _line(error):
    """FILE:LINE:COLUMN: FIELD: MESSAGE, as on the command line."""
    file, line, column, field, message = error
    place = ":".join(str(part) for part in (file, line, column) if part is not None)
    return ": ".join(part for part in (place, field, message) if part)
