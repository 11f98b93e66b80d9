//! Built-in fonts, and the search for the glyph of a letter.

use std::sync::OnceLock;

use ttf_parser::{Face as Parsed, GlyphId};

/// Built-in font; see `fonts/README.md` for its origin.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Face {
    /// Arimo: Latin, Greek, Cyrillic, arrows, mathematics.
    Regular,
    /// Arimo Bold, with the same letters.
    Bold,
    /// Droid Sans Fallback: Chinese and Japanese.
    EastAsian,
}

/// Result of the search for a glyph.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Found {
    Glyph(Face, GlyphId),
    /// The letter is invisible and needs no glyph.
    Nothing,
    /// No built-in font has a glyph for the letter.
    Nowhere,
}

impl Face {
    /// All fonts.
    pub(super) const ALL: [Face; 3] = [Face::Regular, Face::Bold, Face::EastAsian];

    /// Name of the font in the PDF file.
    pub(super) fn name(self) -> &'static str {
        match self {
            Face::Regular => "Arimo",
            Face::Bold => "Arimo-Bold",
            Face::EastAsian => "DroidSansFallback",
        }
    }

    /// Name of the font among the page resources.
    pub(super) fn resource(self) -> &'static [u8] {
        match self {
            Face::Regular => b"F0",
            Face::Bold => b"F1",
            Face::EastAsian => b"F2",
        }
    }

    /// Width of vertical stems, in thousandths of the font size.
    pub(super) fn stem(self) -> f32 {
        match self {
            Face::Regular | Face::EastAsian => 88.0,
            Face::Bold => 138.0,
        }
    }

    /// Font file, decompressed on first use.
    pub(super) fn bytes(self) -> &'static [u8] {
        static REGULAR: OnceLock<Vec<u8>> = OnceLock::new();
        static BOLD: OnceLock<Vec<u8>> = OnceLock::new();
        static EAST_ASIAN: OnceLock<Vec<u8>> = OnceLock::new();
        let (kept, packed): (&'static OnceLock<Vec<u8>>, &[u8]) = match self {
            Face::Regular => (
                &REGULAR,
                include_bytes!("../../../fonts/arimo-regular.ttf.zlib"),
            ),
            Face::Bold => (&BOLD, include_bytes!("../../../fonts/arimo-bold.ttf.zlib")),
            Face::EastAsian => (
                &EAST_ASIAN,
                include_bytes!("../../../fonts/droid-fallback.ttf.zlib"),
            ),
        };
        kept.get_or_init(|| {
            miniz_oxide::inflate::decompress_to_vec_zlib(packed)
                .expect("the fonts that are built in can be decompressed")
        })
    }

    /// Parsed glyphs and their widths.
    pub(super) fn parsed(self) -> &'static Parsed<'static> {
        static REGULAR: OnceLock<Parsed<'static>> = OnceLock::new();
        static BOLD: OnceLock<Parsed<'static>> = OnceLock::new();
        static EAST_ASIAN: OnceLock<Parsed<'static>> = OnceLock::new();
        let kept = match self {
            Face::Regular => &REGULAR,
            Face::Bold => &BOLD,
            Face::EastAsian => &EAST_ASIAN,
        };
        kept.get_or_init(|| {
            Parsed::parse(self.bytes(), 0).expect("the fonts that are built in can be read")
        })
    }

    /// Advance width of a glyph, as a share of the font size.
    pub(super) fn advance(self, glyph: GlyphId) -> f64 {
        let parsed = self.parsed();
        let units = parsed.glyph_hor_advance(glyph).unwrap_or(0);
        f64::from(units) / f64::from(parsed.units_per_em())
    }
}

/// Finds the glyph of `letter`.
pub(super) fn find(letter: char, bold: bool) -> Found {
    let european = if bold { Face::Bold } else { Face::Regular };
    let glyph = |face: Face, letter| {
        let glyph = face.parsed().glyph_index(letter)?;
        Some(Found::Glyph(face, glyph))
    };
    if is_unseen(letter) {
        return Found::Nothing;
    }
    let found = glyph(european, letter);
    // Avoids decompressing the large font for a space that Arimo lacks.
    let found = found.or_else(|| letter.is_whitespace().then(|| glyph(european, ' '))?);
    let found = found.or_else(|| glyph(Face::EastAsian, letter));
    found.unwrap_or(Found::Nowhere)
}

/// True for joiners, direction marks and variant selectors.
fn is_unseen(letter: char) -> bool {
    matches!(letter, '\u{ad}' | '\u{200b}'..='\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{fe00}'..='\u{fe0f}' | '\u{feff}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_come_from_the_font_that_has_them() {
        let face = |letter, bold| match find(letter, bold) {
            Found::Glyph(face, _) => Some(face),
            _ => None,
        };
        for letter in "Aé€ŁğΩµεσδΔЖ−–…≤≥≈×·±°→←↑↓²⁻₀√∞".chars()
        {
            assert_eq!(face(letter, false), Some(Face::Regular), "{letter}");
            assert_eq!(face(letter, true), Some(Face::Bold), "{letter}");
        }
        for letter in "触觉传感器觸覺感測器かなカナ，（）".chars() {
            assert_eq!(face(letter, true), Some(Face::EastAsian), "{letter}");
        }
        assert_eq!(find('\u{200d}', false), Found::Nothing);
        assert_eq!(find('\u{3000}', true), find(' ', true));
        for letter in ['한', 'ก', '🖐', '\u{10ffff}'] {
            assert_eq!(find(letter, false), Found::Nowhere, "{letter}");
        }
    }

    #[test]
    fn arimo_is_as_wide_as_helvetica() {
        let width = |letter, bold| match find(letter, bold) {
            Found::Glyph(face, glyph) => format!("{:.0}", face.advance(glyph) * 1000.0),
            _ => String::new(),
        };
        let widths = ['S', '(', ' ', 'm', '−'].map(|letter| width(letter, false));
        assert_eq!(widths, ["667", "333", "278", "833", "584"]);
        assert_eq!(width('t', true), "333");
    }
}
