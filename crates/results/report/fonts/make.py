#!/usr/bin/env python3
"""Makes the fonts of this folder from the Debian packages fonts-croscore and fonts-droid-fallback.

Needs fontTools (`pip install fonttools`). Letters are kept by script, hinting and layout tables are dropped, and each file is
compressed by zlib.
"""

import io
import zlib

from fontTools import subset
from fontTools.ttLib import TTFont

ARIMO = "/usr/share/fonts/truetype/croscore/Arimo-%s.ttf"
DROID = "/usr/share/fonts/truetype/droid/DroidSansFallbackFull.ttf"

# Latin, Greek, Cyrillic, marks, punctuation, arrows, mathematics, shapes.
EUROPEAN = [
    (0x20, 0x7E), (0xA0, 0x24F), (0x2C6, 0x2DD), (0x300, 0x36F), (0x370, 0x52F), (0x1E00, 0x1FFF),
    (0x2000, 0x23FF), (0x25A0, 0x26FF), (0xFB00, 0xFB06), (0xFFFD, 0xFFFD),
]
# Punctuation, hiragana, katakana and letters of full width.
EAST_ASIAN = [(0x3000, 0x30FF), (0xFF00, 0xFFEF)]


def ranges(pairs):
    return {letter for first, last in pairs for letter in range(first, last + 1)}


def letters_of(encoding, rows, columns):
    """Return the letters of two-byte codes in an encoding."""
    letters = set()
    for row in rows:
        for column in columns:
            try:
                letters.add(ord(bytes([row, column]).decode(encoding)))
            except (UnicodeDecodeError, TypeError):
                pass
    return letters


def ideographs():
    """Return all ideographs of GB 2312, and the frequent ones of Big5 and of JIS X 0208."""
    high = range(0xA1, 0xFF)
    simplified = letters_of("gb2312", range(0xB0, 0xF8), high)
    traditional = letters_of("big5", range(0xA4, 0xC7), [*range(0x40, 0x7F), *high])
    japanese = letters_of("euc_jp", range(0xB0, 0xD0), high)
    return simplified | traditional | japanese


def make(source, target, letters):
    options = subset.Options(
        hinting=False, layout_features=[], glyph_names=False, notdef_outline=True, recalc_timestamp=False, name_IDs=[0, 1, 2, 4, 5, 6, 7, 13, 14]
    )
    options.drop_tables += ["GSUB", "GPOS", "GDEF", "kern", "gasp", "DSIG", "LTSH", "hdmx", "VDMX", "PCLT"]
    font = TTFont(source, recalcTimestamp=False)
    subsetter = subset.Subsetter(options)
    subsetter.populate(unicodes=letters & set(font.getBestCmap()))
    subsetter.subset(font)
    out = io.BytesIO()
    font.save(out)
    with open(target, "wb") as file:
        file.write(zlib.compress(out.getvalue(), 9))


make(ARIMO % "Regular", "arimo-regular.ttf.zlib", ranges(EUROPEAN))
make(ARIMO % "Bold", "arimo-bold.ttf.zlib", ranges(EUROPEAN))
make(DROID, "droid-fallback.ttf.zlib", ranges(EAST_ASIAN) | ideographs())
