#!/usr/bin/env python3
"""Checks the documentation: every Markdown file that git tracks, and those not yet added.

    scripts/check_docs.py                             # links, paths, index, length of the README
    scripts/check_docs.py build/release/cli/relief    # also the command reference

Prints one line for each problem and exits with 1 if there is any.

- Every relative link leads to a file, and its #anchor to a heading of that file.
- Every path in backticks or in a code block that begins with a folder of this repository exists.
  In `renderer/engines/NAME/` words in capitals and `*` stand for anything.
- Every `#include <relief/...>` names a header of this repository.
- docs/README.md leads to every page in docs/, directly or through another page.
- Every image in docs/images is shown.
- README.md has at most 120 lines.
"""
import argparse
import pathlib
import re
import subprocess
import sys
import urllib.parse

ROOT = pathlib.Path(__file__).resolve().parent.parent
FOLDERS = "cli|cmake|common|docs|integrations|loader|models|preprocess|renderer|scripts|shaders|tests|viewer"
MAX_README_LINES = 120

PATH = re.compile(rf"(?<![\w./<-])((?:{FOLDERS})/[\w./*{{}},+-]*)")
INCLUDE = re.compile(r"<relief/(\w[\w./-]*)>")
LINK = re.compile(r"\]\(([^()\s]*(?:\([^()\s]*\))?[^()\s]*)\)")
SPAN = re.compile(r"(`+)(.+?)\1")


def list_pages():
    """All Markdown files that git tracks or could track."""
    listed = subprocess.run(["git", "ls-files", "-co", "--exclude-standard", "*.md"], cwd=ROOT,
                            capture_output=True, text=True, check=True)
    names = sorted(set(listed.stdout.split()))
    return [ROOT / name for name in names if (ROOT / name).exists()]


class Page:
    """One page: its prose and its code, each with line numbers, and the anchors of its headings."""

    def __init__(self, path):
        self.path = path
        self.name = str(path.relative_to(ROOT))
        self.lines = path.read_text(encoding="utf-8").splitlines()
        self.prose, self.code, self.anchors = [], [], set()
        fence = None
        for number, line in enumerate(self.lines, 1):
            mark = re.match(r"\s*(```+|~~~+)", line)
            if mark and fence is None:
                fence = mark[1]
            elif mark and mark[1].startswith(fence):
                fence = None
            elif fence is not None:
                self.code.append((number, line))
            else:
                self.add_prose(number, line)

    def add_prose(self, number, line):
        for span in SPAN.finditer(line):
            self.code.append((number, span[2]))
        self.prose.append((number, SPAN.sub("", line)))
        heading = re.match(r"#+\s+(.*)", line)
        if heading:
            self.anchors.add(self.unused_anchor(heading[1]))
        for anchor in re.finditer(r'<a (?:id|name)="([^"]+)"', line):
            self.anchors.add(anchor[1])

    def unused_anchor(self, heading):
        """The anchor that GitHub gives to a heading."""
        text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading.replace("`", ""))
        base = re.sub(r"[^\w\- ]", "", text.strip().lower()).replace(" ", "-")
        anchor, count = base, 0
        while anchor in self.anchors:
            count += 1
            anchor = f"{base}-{count}"
        return anchor


def exists(pattern):
    """Whether a path of the repository exists; words in capitals, `*` and `{...}` match anything."""
    pattern = pattern.rstrip("./,")
    if re.search(r"[*{]", pattern) or re.search(r"(?<![A-Za-z])[A-Z]{2,}(?![A-Za-z])", pattern):
        if (ROOT / pattern).exists():
            return True
        pattern = re.sub(r"\{[^}]*\}|(?<![A-Za-z])[A-Z]{2,}(?![A-Za-z])", "*", pattern)
        return any(ROOT.glob(pattern))
    return (ROOT / pattern).exists()


def check_links(page, pages, problems):
    """Checks the links of a page; returns the files that they lead to."""
    found = set()
    for number, line in page.prose:
        for link in LINK.finditer(line):
            target = link[1]
            if re.match(r"[a-z][a-z+.-]*:", target):
                continue
            file, _, anchor = target.partition("#")
            path = (page.path.parent / urllib.parse.unquote(file)).resolve() if file else page.path
            if not path.exists() or ROOT not in [path, *path.parents]:
                problems.append(f"{page.name}:{number}: the link {target} leads to no file")
                continue
            found.add(path)
            if anchor and path in pages and anchor not in pages[path].anchors:
                problems.append(f"{page.name}:{number}: the link {target} leads to no heading")
    return found


def check_paths(page, problems):
    for number, text in page.code:
        for match in PATH.finditer(text):
            if not exists(match[1]):
                problems.append(f"{page.name}:{number}: {match[1]} does not exist")
        for match in INCLUDE.finditer(text):
            # What is in integrations/ is installed at the top (cmake/InstallHeaders.cmake).
            if not any((root / match[1]).exists() for root in (ROOT, ROOT / "integrations")):
                problems.append(f"{page.name}:{number}: <relief/{match[1]}> is no header of this repository")


def check_index(links, problems):
    """Every page in docs/ and every image must be reachable from docs/README.md or README.md."""
    start = [ROOT / "docs" / "README.md", ROOT / "README.md"]
    reached, open_pages = set(), [page for page in start if page in links]
    while open_pages:
        page = open_pages.pop()
        for target in links.get(page, ()):
            if target not in reached:
                reached.add(target)
                open_pages.append(target)
    for path in sorted((ROOT / "docs").rglob("*")):
        if path.is_file() and path not in reached and path not in start:
            problems.append(f"{path.relative_to(ROOT)}: no page that docs/README.md leads to links to it")


def check_reference(relief, problems):
    script = ROOT / "scripts" / "command_reference.py"
    done = subprocess.run([sys.executable, script, relief, "--check"], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        problems.append(done.stdout + done.stderr.strip())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("relief", nargs="?", help="the built command, to check docs/command-reference.md")
    arguments = parser.parse_args()
    pages = {path: Page(path) for path in list_pages()}
    problems = []
    links = {}
    for path, page in pages.items():
        links[path] = check_links(page, pages, problems)
        check_paths(page, problems)
    check_index(links, problems)
    lines = len(pages[ROOT / "README.md"].lines)
    if lines > MAX_README_LINES:
        problems.append(f"README.md: {lines} lines; at most {MAX_README_LINES} are allowed")
    if arguments.relief:
        check_reference(arguments.relief, problems)
    for problem in problems:
        print(problem)
    if problems:
        sys.exit(f"check_docs.py: {len(problems)} problems")


if __name__ == "__main__":
    main()
