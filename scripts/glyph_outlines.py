#!/usr/bin/env python3
"""Writes common/legend/glyph_outlines.inc: outlines of DejaVu Sans, ASCII only.

Needs `pip install fonttools` and Debian's fonts-dejavu-core.
"""
import pathlib

from fontTools.pens.basePen import BasePen
from fontTools.ttLib import TTFont

FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"
PIECES = 3  # of a curve: at 60 pixels a letter they stay within a tenth of a pixel

HEADER = """\
// Outlines of the printable ASCII characters of DejaVu Sans 2.37, as polygons. Written by
// scripts/glyph_outlines.py; do not edit. For each character from the blank to the tilde: its
// advance, the number of its contours, and for each contour its number of points and their
// coordinates, in 1/2048 of an em, y upward from the base line.
//
// Fonts are (c) Bitstream. DejaVu changes are in public domain. Copyright (c) 2003 by Bitstream,
// Inc. All Rights Reserved. Bitstream Vera is a trademark of Bitstream, Inc.
//   Permission is hereby granted, free of charge, to any person obtaining a copy of the fonts
//   accompanying this license ("Fonts") and associated documentation files (the "Font Software"),
//   to reproduce and distribute the Font Software, including without limitation the rights to use,
//   copy, merge, publish, distribute, and/or sell copies of the Font Software, and to permit
//   persons to whom the Font Software is furnished to do so, subject to the following conditions:
//   The above copyright and trademark notices and this permission notice shall be included in all
//   copies of one or more of the Font Software typefaces. The Font Software may be modified,
//   altered, or added to, and in particular the designs of glyphs or characters in the Fonts may be
//   modified and additional glyphs or characters may be added to the Fonts, only if the fonts are
//   renamed to names not containing either the words "Bitstream" or the word "Vera". This License
//   becomes null and void to the extent applicable to Fonts or Font Software that has been modified
//   and is distributed under the "Bitstream Vera" names. The Font Software may be sold as part of a
//   larger software package but no copy of one or more of the Font Software typefaces may be sold
//   by itself. THE FONT SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR
//   IMPLIED, INCLUDING BUT NOT LIMITED TO ANY WARRANTIES OF MERCHANTABILITY, FITNESS FOR A
//   PARTICULAR PURPOSE AND NONINFRINGEMENT OF COPYRIGHT, PATENT, TRADEMARK, OR OTHER RIGHT. IN NO
//   EVENT SHALL BITSTREAM OR THE GNOME FOUNDATION BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER
//   LIABILITY, INCLUDING ANY GENERAL, SPECIAL, INDIRECT, INCIDENTAL, OR CONSEQUENTIAL DAMAGES,
//   WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM, OUT OF THE USE OR INABILITY
//   TO USE THE FONT SOFTWARE OR FROM OTHER DEALINGS IN THE FONT SOFTWARE.
"""


class Polygons(BasePen):
    def __init__(self, glyphs):
        super().__init__(glyphs)
        self.contours = []

    def _moveTo(self, p):
        self.contours.append([p])

    def _lineTo(self, p):
        self.contours[-1].append(p)

    def _qCurveToOne(self, control, end):
        start = self.contours[-1][-1]
        for k in range(1, PIECES + 1):
            t = k / PIECES
            weights = (1 - t) ** 2, 2 * t * (1 - t), t * t
            self.contours[-1].append(tuple(
                sum(w * q[c] for w, q in zip(weights, (start, control, end))) for c in (0, 1)))


font = TTFont(FONT)
assert font["head"].unitsPerEm == 2048
glyphs = font.getGlyphSet()
names = font.getBestCmap()
text = HEADER + "constexpr std::int16_t kGlyphs[]{\n"
for code in range(32, 127):
    pen = Polygons(glyphs)
    glyphs[names[code]].draw(pen)
    numbers = [glyphs[names[code]].width, len(pen.contours)]
    for contour in pen.contours:
        points = [(round(x), round(y)) for x, y in contour]
        if points[0] == points[-1]:
            points.pop()
        numbers.append(len(points))
        numbers += [c for p in points for c in p]
    words = [f"{n}," for n in numbers]
    line = "   "
    for word in words:
        if len(line) + 1 + len(word) > 100:
            text += line + "\n"
            line = "   "
        line += " " + word
    text += line + "\n"
out = pathlib.Path(__file__).parent.parent / "common/legend/glyph_outlines.inc"
out.write_text(text + "};\n")
