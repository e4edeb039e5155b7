# SPDX-License-Identifier: MIT
"""Small changes of C text, one at a time: what a test of that text has to notice. The same text gives the same
mutants."""

import re
from typing import Iterator, NamedTuple


class Mutant(NamedTuple):
    line: int  # of the text, from 0
    before: str  # the line
    after: str  # what becomes of it

    def apply(self, text: str) -> str:
        lines = text.split("\n")
        lines[self.line] = self.after
        return "\n".join(lines)


# A binary operator stands between blanks, as the project writes them.
OPERATORS = [
    (" + ", [" - "]),
    (" - ", [" + "]),
    (" * ", [" / "]),
    (" / ", [" * "]),
    (" < ", [" <= ", " >= "]),
    (" > ", [" >= ", " <= "]),
    (" <= ", [" < "]),
    (" >= ", [" > "]),
    (" == ", [" != "]),
    (" != ", [" == "]),
    (" && ", [" || "]),
    (" || ", [" && "]),
    (" & ", [" | "]),
    (" | ", [" & "]),
    (" |= ", [" = "]),
    (" += ", [" -= ", " = "]),
    (" -= ", [" += "]),
]
STATUS = re.compile(r"\bLQG_(?!OK\b)(?:OUTPUT|INNOVATION|INPUT|STATE|COVARIANCE|REFERENCE)_\w+|\bLQG_OK\b")
INTEGER = re.compile(r"(?<![\w.])(\d+)(uL|u)?(?![\w.])")
REAL = re.compile(r"(?<![\w.])(\d+\.\d+(?:e[+-]?\d+)?)(f?)(?![\w.])")
NEGATION = re.compile(r"(?<=[ (])[!~](?=[\w(])|(?<=[(=,] )-(?=[\w(])|(?<=return )-(?=[\w(])")
CHOICE = re.compile(r" \? ([^?:]+) : ([^?:;]+?)(?=[;)]|$)")
DELETABLE = re.compile(r"^\s+(?:\*?[\w>.\-]+(?:\[[^=]*\])?\s[|+\-]?=\s.*|\w+\(.*\)|[\w>.\-]+\+\+);$")
CONSTANT = re.compile(r"^#define \w+ +\(?-?\d+\.\d+(?:e[+-]?\d+)?f?\)?(?: +/\*.*)?$")  # a limit, a bound, a threshold
CONDITION = re.compile(r"^(\s*if )\((.*)\)( \{)?$")


def code_of(line: str) -> str:
    """The line with blanks in place of comments and strings."""
    return re.sub(r'/\*.*?\*/|"(?:[^"\\]|\\.)*"', lambda found: " " * len(found.group()), line)


def changes(line: str) -> Iterator[str]:
    code = code_of(line)

    def put(start: int, end: int, text: str) -> str:
        return line[:start] + text + line[end:]

    for operator, others in OPERATORS:
        for found in re.finditer(re.escape(operator), code):
            for other in others:
                yield put(*found.span(), other)
    for found in STATUS.finditer(code):
        yield put(*found.span(), "LQG_INPUT_LIMITED" if found.group() == "LQG_OK" else "LQG_OK")
    for found in INTEGER.finditer(code):
        yield put(*found.span(), str(int(found.group(1)) + 1) + (found.group(2) or ""))
    for found in REAL.finditer(code):
        factor = "1.001" + found.group(2)
        yield put(
            *found.span(), "1.0" + found.group(2) if float(found.group(1)) == 0 else f"({found.group()} * {factor})"
        )
    for found in NEGATION.finditer(code):
        yield put(*found.span(), "")
    for found in CHOICE.finditer(code):
        yield put(*found.span(), f" ? {found.group(2)} : {found.group(1)}")
    condition = CONDITION.match(code)
    if condition:
        yield f"{condition.group(1)}(!({line[condition.start(2) : condition.end(2)]})){condition.group(3) or ''}"
    if DELETABLE.match(code) and not code.lstrip().startswith("return"):
        yield re.match(r"\s*", line).group() + ";"


def mutants(text: str, begin: str = "LQG_STRICT_BEGIN", end: str = "LQG_STRICT_END") -> Iterator[Mutant]:
    """Of the code between two lines that begin so; of all of it where there is none, and of constants before it. Not of
    comments and other directives."""
    lines = text.split("\n")
    inside = not any(line.startswith(begin) for line in lines)
    comment = False
    for number, line in enumerate(lines):
        if line.startswith(begin) or line.startswith(end):
            inside = line.startswith(begin)
            continue
        opened = comment
        code = re.sub(r"/\*.*?\*/", "", line)
        comment = "/*" in code or (comment and "*/" not in code)
        is_code = not opened and not comment and not line.startswith("#") and line.rstrip()[-1:] != "\\"
        is_statement = inside and is_code and "static inline" not in line and not line.startswith("__attribute__")
        if is_statement or CONSTANT.match(line):
            for after in dict.fromkeys(changes(line)):
                if after != line:
                    yield Mutant(number, line, after)
