#!/usr/bin/env python3
"""Whether the pages are true where a program can tell: README.md and docs/*.md.

  docs.py PROJECT-FOLDER C-COMPILER

Their C code compiles against the public headers (the pieces of a page follow each other in one file), their
links lead somewhere, and files and lks_ names that they mention exist. What does not is printed, a line each.
"""

import pathlib
import re
import subprocess
import sys
import tempfile

PATH = re.compile(r"\b(?:sdk|tests|docs|demos|render|bench|accuracy|golden|scripts|cmake)/[\w./*-]*[\w*]")
NAME = re.compile(r"\b(?:lks|LKS)_\w+\b")
LINK = re.compile(r"\[[^\]]*\]\(([^)\s]+)\)")


def parts(text):
    """The page without its code, and its C code."""
    prose, code, language = [], [], None
    for line in text.splitlines():
        if line.startswith("```"):
            language = line[3:].strip() or "text" if language is None else None
            continue
        (code if language == "c" else prose if language is None else []).append(line)
    return "\n".join(prose), "\n".join(code)


def anchors(text):
    """Of headings, as GitHub makes them."""
    found = set()
    for heading in re.findall(r"^#+ +(.*)$", parts(text)[0], re.MULTILINE):
        plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).lower()
        found.add(re.sub(r"[^\w\- ]", "", plain).strip().replace(" ", "-"))
    return found


def wrong_links(page, prose):
    for target in LINK.findall(prose):
        if re.match(r"\w+:", target):
            continue
        path, _, anchor = target.partition("#")
        file = (page.parent / path).resolve() if path else page
        if not file.exists():
            yield f"the link to {target} leads nowhere"
        elif anchor and anchor not in anchors(file.read_text()):
            yield f"{file.name} has no heading #{anchor}"


def wrong_names(project, prose, known):
    # A path may stand for several, or leave out the ending that a header and its source share.
    for path in sorted(set(PATH.findall(LINK.sub("", prose)))):
        if not list(project.glob(path)) and not list(project.glob(path + ".*")):
            yield f"there is no {path}"
    for name in sorted(set(NAME.findall(prose))):
        if name not in known and not (name.endswith("_") and any(k.startswith(name) for k in known)):
            yield f"the headers know no {name}"


def wrong_code(project, compiler, code):
    if not code:
        return
    with tempfile.TemporaryDirectory() as folder:
        source = pathlib.Path(folder) / "page.c"
        source.write_text(code + "\n")
        command = [compiler, "-std=c99", "-fsyntax-only", "-Wall", "-Wextra", "-Werror",
                   f"-I{project / 'sdk/include'}", str(source)]
        run = subprocess.run(command, capture_output=True, text=True, check=False)
    if run.returncode != 0:
        yield "the C code does not compile:\n" + run.stderr


def main():
    if len(sys.argv) != 3:
        print(__doc__, file=sys.stderr)
        return 2
    project = pathlib.Path(sys.argv[1]).resolve()
    known = set()
    for header in (project / "sdk/include").rglob("*.h"):
        known |= set(NAME.findall(header.read_text()))
    pages = [project / "README.md", *sorted((project / "docs").glob("*.md"))]
    wrong = 0
    for page in pages:
        prose, code = parts(page.read_text())
        for sentence in [*wrong_links(page, prose), *wrong_names(project, prose, known),
                         *wrong_code(project, sys.argv[2], code)]:
            print(f"{page.relative_to(project)}: {sentence}")
            wrong += 1
    for source in sorted((project / "sdk").rglob("*.h")):
        for path in sorted(set(re.findall(r"docs/[\w-]+\.md", source.read_text()))):
            if not (project / path).exists():
                print(f"{source.relative_to(project)}: there is no {path}")
                wrong += 1
    print(f"{len(pages)} pages, {wrong} mistakes")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
