"""The parts of a page: paragraphs, tables and plots."""


class Section:
    def __init__(self, title):
        self.lines = [f"## {title}", ""]
        self.plots = []
        self.wrong = []  # what is not as it should be, for --check

    def text(self, *sentences):
        self.lines += [" ".join(sentences), ""]

    def table(self, head, rows):
        """Adds a table, if it has rows."""
        if not rows:
            return
        self.lines += ["| " + " | ".join(head) + " |", "|" + " --- |" * len(head)]
        self.lines += ["| " + " | ".join(map(str, row)) + " |" for row in rows] + [""]

    def plot(self, plot):
        """Adds a plot (plot.Plot), whose file the page's writer writes."""
        self.plots.append(plot)
        self.lines += [f"![{plot.title}](images/{plot.file})", ""]
