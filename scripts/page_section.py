"""The part of a page that a script writes, between two lines of the page."""
import sys


def write_section(page, begin, end, text):
    """Puts the text between the lines; ends the script with one sentence if the page lacks one of them."""
    old = page.read_text(encoding="utf-8")
    if begin not in old or end not in old:
        sys.exit(f"{sys.argv[0].rsplit('/', 1)[-1]}: {page} lacks the lines {begin} and {end}")
    before, after = old[:old.index(begin)], old[old.index(end):]
    page.write_text(f"{before}{begin}\n\n{text.rstrip()}\n\n{after}", encoding="utf-8")
