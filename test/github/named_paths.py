# SPDX-License-Identifier: MIT
"""named_paths.py ROOT: fails where .github/ or .pre-commit-config.yaml name a file or folder of this tree that does not
exist, or a heading that a document does not have."""

import re
import sys
from pathlib import Path

LINK = re.compile(r"\]\(([^)#\s]*)(?:#([^)\s]+))?\)")
# A word with a slash in it; not of an address or an option's value.
WORD = re.compile(r"(?<![\w./:<$@=-])/?((?:\.?[A-Za-z][\w-]*/)+[\w.-]*\w)(?![\w/*])")
ELSEWHERE = re.compile(r"#!.*|\buses:.*")  # the system's programs, GitHub's actions
MADE = re.compile(r"(build|refs/heads)(/|$)")  # by a build, by git


def slug(heading):
    """GitHub's name of a heading."""
    return re.sub(r"[^\w -]", "", heading.strip().lower()).replace(" ", "-")


def headings(document):
    text = re.sub(r"^```.*?^```", "", document.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL)
    return {slug(heading) for heading in re.findall(r"^#+ (.*)$", text, flags=re.MULTILINE)}


def missing(root, file):
    """What this file names and is not there, each with its line."""
    for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), 1):
        for target, heading in LINK.findall(line) if file.suffix == ".md" else ():
            if "://" in target:
                continue
            path = file.parent / target if target else file
            if not path.exists():
                yield number, target
            elif heading and heading not in headings(path):
                yield number, f"{target}#{heading}"
        for word in WORD.findall(ELSEWHERE.sub("", LINK.sub("]", line))):
            if not MADE.match(word) and not (root / word).exists():
                yield number, word


def main():
    root = Path(sys.argv[1])
    files = [file for file in sorted(root.glob(".github/**/*")) if file.is_file()] + [root / ".pre-commit-config.yaml"]
    failed = False
    for file in files:
        for number, name in missing(root, file):
            print(f"{file.relative_to(root)}:{number}: expected the path of something in the tree, found {name}")
            failed = True
    return failed


sys.exit(main())
