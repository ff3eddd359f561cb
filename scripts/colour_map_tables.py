#!/usr/bin/env python3
"""Writes common/scalars/colour_map_tables.inc from the published tables.

Needs `pip install matplotlib cmcrameri`, which hold them as their authors published them:
viridis, magma, inferno, plasma (CC0), cividis (Battelle, BSD style), turbo (Apache-2.0), batlow (MIT).
"""
import pathlib

import cmcrameri.cm
import matplotlib

HEADER = """\
// Perceptual colour maps, 256 entries each, 8-bit sRGB as 0xRRGGBB. Written by
// scripts/colour_map_tables.py from the published tables; do not edit.
//
// viridis, magma, inferno, plasma: Stefan van der Walt and Nathaniel Smith, 2015. CC0 1.0.
// turbo: Copyright 2019 Google LLC, Anton Mikhailov. Apache-2.0.
// cividis: Jamie Nunez, Christopher Anderton, Ryan Renslow, 2018. Copyright (c) 2017, Battelle
// Memorial Institute:
//   1. Battelle Memorial Institute (hereinafter Battelle) hereby grants permission to any person or
//   entity lawfully obtaining a copy of this software and associated documentation files
//   (hereinafter "the Software") to redistribute and use the Software in source and binary forms,
//   with or without modification. Such person or entity may use, copy, modify, merge, publish,
//   distribute, sublicense, and/or sell copies of the Software, and may permit others to do so,
//   subject to the following conditions:
//   + Redistributions of source code must retain the above copyright notice, this list of
//   conditions and the following disclaimers.
//   + Redistributions in binary form must reproduce the above copyright notice, this list of
//   conditions and the following disclaimer in the documentation and/or other materials provided
//   with the distribution.
//   + Other than as used herein, neither the name Battelle Memorial Institute or Battelle may be
//   used in any form whatsoever without the express written consent of Battelle.
//   2. THIS SOFTWARE IS PROVIDED BY THE COPYRIGHT HOLDERS AND CONTRIBUTORS "AS IS" AND ANY EXPRESS
//   OR IMPLIED WARRANTIES, INCLUDING, BUT NOT LIMITED TO, THE IMPLIED WARRANTIES OF
//   MERCHANTABILITY AND FITNESS FOR A PARTICULAR PURPOSE ARE DISCLAIMED. IN NO EVENT SHALL BATTELLE
//   OR CONTRIBUTORS BE LIABLE FOR ANY DIRECT, INDIRECT, INCIDENTAL, SPECIAL, EXEMPLARY, OR
//   CONSEQUENTIAL DAMAGES (INCLUDING, BUT NOT LIMITED TO, PROCUREMENT OF SUBSTITUTE GOODS OR
//   SERVICES; LOSS OF USE, DATA, OR PROFITS; OR BUSINESS INTERRUPTION) HOWEVER CAUSED AND ON ANY
//   THEORY OF LIABILITY, WHETHER IN CONTRACT, STRICT LIABILITY, OR TORT (INCLUDING NEGLIGENCE OR
//   OTHERWISE) ARISING IN ANY WAY OUT OF THE USE OF THIS SOFTWARE, EVEN IF ADVISED OF THE
//   POSSIBILITY OF SUCH DAMAGE.
// batlow: Copyright (c) 2020 Fabio Crameri. MIT:
//   Permission is hereby granted, free of charge, to any person obtaining a copy of this software
//   and associated documentation files (the "Software"), to deal in the Software without
//   restriction, including without limitation the rights to use, copy, modify, merge, publish,
//   distribute, sublicense, and/or sell copies of the Software, and to permit persons to whom the
//   Software is furnished to do so, subject to the following conditions: The above copyright notice
//   and this permission notice shall be included in all copies or substantial portions of the
//   Software. THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR IMPLIED,
//   INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY, FITNESS FOR A PARTICULAR
//   PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR
//   ANY CLAIM, DAMAGES OR OTHER LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE,
//   ARISING FROM, OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN THE
//   SOFTWARE.
"""


def table(name, colour_map):
    assert colour_map.N == 256
    entries = []
    for k in range(256):
        r, g, b = (round(255 * c) for c in colour_map(k)[:3])
        entries.append(f"0x{r:02X}{g:02X}{b:02X}")
    rows = [", ".join(entries[k:k + 9]) for k in range(0, 256, 9)]
    return f"constexpr ColourTable k{name.capitalize()}{{\n    " + ",\n    ".join(rows) + "};\n"


maps = {name: matplotlib.colormaps[name]
        for name in ("viridis", "cividis", "inferno", "magma", "plasma", "turbo")}
maps["batlow"] = cmcrameri.cm.batlow
out = pathlib.Path(__file__).parent.parent / "common/scalars/colour_map_tables.inc"
out.write_text(HEADER + "".join(table(name, m) for name, m in maps.items()))
