#!/usr/bin/env python3
"""Whether constants mean the same where a build joins the SDK's sources (CMAKE_UNITY_BUILD).

  joined_names.py SDK-SOURCE-FOLDER

Joined sources share their unnamed namespace. What one of them names there hides what a header has named
before, in all that come behind it, and no compiler says so. So no constant in an unnamed namespace has the
name of one that a header of its folder, or one that a source of its folder includes, has in the namespace
around it.
"""
import pathlib
import re
import sys

constant = re.compile(r"^(?:inline )?constexpr [\w:<> ]+?\b(\w+)(?:\[\w*\])*(?: =|\{|;)", re.M)
namespace = re.compile(r"^namespace ([\w:]+) \{", re.M)
unnamed = re.compile(r"^namespace \{\n(.*?)^\} // namespace$", re.M | re.S)
included = re.compile(r'^#include "([^"]+)"', re.M)


def read(path):
    return path.read_text(encoding="utf-8")


def headers_of(files, root):
    """All that these include, and what that includes."""
    found, open_files = set(), list(files)
    while open_files:
        for name in included.findall(read(open_files.pop())):
            path = root / name
            if path.exists() and path not in found:
                found.add(path)
                open_files.append(path)
    return found


def hidden_names(root):
    folders = {}
    for source in sorted(root.rglob("*.cpp")):
        folders.setdefault(source.parent, []).append(source)
    for sources in folders.values():
        named = {}
        for header in headers_of(sources, root):
            text = read(header)
            for around in namespace.findall(text):
                for name in constant.findall(text):
                    named[around, name] = header
        for source in sources:
            text = read(source)
            for around in namespace.findall(text):
                for body in unnamed.findall(text):
                    for name in constant.findall(body):
                        if (around, name) in named:
                            yield source, name, named[around, name]


def main():
    if len(sys.argv) != 2:
        print(__doc__)
        return 2
    root = pathlib.Path(sys.argv[1])
    found = list(hidden_names(root))
    for source, name, header in found:
        print(f"{source}: '{name}' hides that of {header.relative_to(root)} in sources that are joined.")
    print(f"{len(list(root.rglob('*.cpp')))} sources, {len(found)} hidden names")
    return 1 if found else 0


sys.exit(main())
