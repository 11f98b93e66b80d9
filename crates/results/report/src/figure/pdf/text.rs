//! Labels: runs of glyphs of one font, and boxes for letters without a glyph.

use std::collections::BTreeMap;

use pdf_writer::{Content, Name, Str};
use subsetter::GlyphRemapper;

use super::code_point_box;
use super::content::number;
use super::face::{Face, Found, find};
use crate::figure::canvas::{Anchor, Label};

/// Glyphs of a font that a figure uses.
pub(super) struct Used {
    pub(super) face: Face,
    /// Used glyphs, numbered in order of first use.
    pub(super) glyphs: GlyphRemapper,
    /// Letter of each glyph.
    pub(super) letters: BTreeMap<u16, char>,
}

impl Used {
    /// Creates the entry of a font without used glyphs.
    pub(super) fn none_of(face: Face) -> Used {
        Used {
            face,
            glyphs: GlyphRemapper::new(),
            letters: BTreeMap::new(),
        }
    }
}

/// Part of a label.
enum Piece {
    Run { face: Face, letters: Vec<u16> },
    Missing(char),
}

/// Draws `label` at `at` in the current colour, and adds its glyphs to `fonts`.
pub(super) fn draw(label: &Label, at: [f64; 2], fonts: &mut [Used; 3], content: &mut Content) {
    let (pieces, length) = pieces(label, fonts);
    let back = match label.anchor {
        Anchor::Start => 0.0,
        Anchor::Middle => length / 2.0,
        Anchor::End => length,
    };
    let [x, y] = at;
    content.transform(match label.upwards {
        true => [0.0, 1.0, -1.0, 0.0, number(x), number(y - back)],
        false => [1.0, 0.0, 0.0, 1.0, number(x - back), number(y)],
    });
    for (piece, pen) in &pieces {
        match piece {
            Piece::Run { face, letters } => {
                let codes: Vec<u8> = letters.iter().flat_map(|code| code.to_be_bytes()).collect();
                content.begin_text();
                content.set_font(Name(face.resource()), number(label.size));
                content.next_line(number(*pen), 0.0);
                content.show(Str(&codes)).end_text();
            }
            Piece::Missing(letter) => {
                code_point_box::draw(*letter, *pen, label.size, fonts, content)
            }
        }
    }
}

/// Parts of a label with their pen positions, and the total length.
fn pieces(label: &Label, fonts: &mut [Used; 3]) -> (Vec<(Piece, f64)>, f64) {
    let mut pieces: Vec<(Piece, f64)> = Vec::new();
    let mut pen = 0.0;
    for letter in label.text.chars() {
        match find(letter, label.bold) {
            Found::Glyph(face, glyph) => {
                let code = code(letter, face, glyph.0, fonts);
                match pieces.last_mut() {
                    Some((
                        Piece::Run {
                            face: last,
                            letters,
                        },
                        _,
                    )) if *last == face => {
                        letters.push(code);
                    }
                    _ => {
                        let letters = vec![code];
                        pieces.push((Piece::Run { face, letters }, pen));
                    }
                }
                pen += face.advance(glyph) * label.size;
            }
            Found::Nothing => {}
            Found::Nowhere => {
                pieces.push((Piece::Missing(letter), pen));
                pen += code_point_box::advance(letter) * label.size;
            }
        }
    }
    (pieces, pen)
}

/// Adds a glyph to `fonts`, and returns its number in the embedded file.
pub(super) fn code(letter: char, face: Face, glyph: u16, fonts: &mut [Used; 3]) -> u16 {
    let Some(used) = fonts.iter_mut().find(|used| used.face == face) else {
        return 0;
    };
    let code = used.glyphs.remap(glyph);
    used.letters.entry(code).or_insert(letter);
    code
}

#[cfg(test)]
mod tests {
    use super::*;

    fn length(text: &str) -> f64 {
        let label = Label::new([0.0, 0.0], text, Anchor::Start);
        pieces(&label, &mut Face::ALL.map(Used::none_of)).1
    }

    #[test]
    fn a_label_is_as_long_as_its_glyphs() {
        // S 667, R 722, parentheses 333 each: 2055 thousandths of 11.
        assert!((length("SR()") - 22.6).abs() < 0.05, "{}", length("SR()"));
        // Ideographs are as wide as high.
        assert!((length("触觉") - 22.0).abs() < 0.2, "{}", length("触觉"));
        assert!(length("\u{200b}").abs() < 1e-9 && length("한") > 5.0);
    }

    #[test]
    fn letters_of_one_font_are_one_run() {
        let label = Label::new([0.0, 0.0], "SR(ε) ↑ 触觉 한 b", Anchor::Start);
        let mut fonts = Face::ALL.map(Used::none_of);
        let (pieces, _) = pieces(&label, &mut fonts);
        let runs: Vec<_> = pieces
            .iter()
            .map(|(piece, _)| match piece {
                Piece::Run { face, letters } => Ok((*face, letters.len())),
                Piece::Missing(letter) => Err(*letter),
            })
            .collect();
        let expected = [
            Ok((Face::Regular, 8)),
            Ok((Face::EastAsian, 2)),
            Ok((Face::Regular, 1)),
            Err('한'),
            Ok((Face::Regular, 2)),
        ];
        assert_eq!(runs, expected);
        // A repeated letter needs one glyph.
        assert_eq!(fonts[0].letters.len(), 8);
    }
}
