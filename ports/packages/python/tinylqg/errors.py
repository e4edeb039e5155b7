"""What goes wrong, in one sentence: what was expected, and what was found."""


class DesignError(ValueError):
    """A plant, a number or a file cannot be what it has to be."""


def expected(where, what, found):
    """The error of `where`, as lqgen words it."""
    return DesignError(f"{where}: expected {what}, found {found}")


def needs(package, what, extra):
    """The error of a package that is not there."""
    return ImportError(f"{what} needs {package}, which is not installed: pip install 'tinylqg[{extra}]'")
