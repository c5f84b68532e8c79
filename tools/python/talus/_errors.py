"""What is wrong with the input."""


class ScenarioError(ValueError):
    """Faults of a model, a file or an argument: all that were found.

    errors: list of (file, line, column, field, message); file, line and column are None where nothing is known.
    """

    def __init__(self, errors):
        self.errors = list(errors)
        super().__init__("\n".join(_line(error) for error in self.errors))

    def __reduce__(self):
        return type(self), (self.errors,)


def _line(error):
    """FILE:LINE:COLUMN: FIELD: MESSAGE, as the command line says it."""
    file, line, column, field, message = error
    place = ":".join(str(part) for part in (file, line, column) if part is not None)
    return ": ".join(part for part in (place, field, message) if part)
