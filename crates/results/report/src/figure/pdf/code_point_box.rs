//! Replacement for a letter without a glyph: a box with its code point.

use pdf_writer::{Content, Finish, Name, Str, TextStr};

use super::content::number;
use super::face::{Face, Found, find};
use super::text::{Used, code};

/// Size of the digits, as a share of the label size.
const DIGITS: f64 = 0.4;
/// Padding around and inside the box, as a share of the label size.
const SPACE: f64 = 0.06;

/// Code point in two rows with equal numbers of digits.
fn rows(letter: char) -> [String; 2] {
    let digits = format!("{:04X}", u32::from(letter));
    let digits = if digits.len() % 2 == 0 {
        digits
    } else {
        format!("0{digits}")
    };
    let (upper, lower) = digits.split_at(digits.len() / 2);
    [upper.to_owned(), lower.to_owned()]
}

/// Width of the box with padding, as a share of the label size.
pub(super) fn advance(letter: char) -> f64 {
    // In Arimo, digits are 0.556 of the size wide, A to F at most 0.722.
    let [upper, _] = rows(letter);
    let digits = u32::try_from(upper.len()).unwrap_or(u32::MAX);
    f64::from(digits) * DIGITS * 0.722 + 4.0 * SPACE
}

/// Draws the box at `pen`, on the baseline of a label of `size`. Copying and searching text still give the letter.
pub(super) fn draw(
    letter: char,
    pen: f64,
    size: f64,
    fonts: &mut [Used; 3],
    content: &mut Content,
) {
    let text = letter.to_string();
    let mut marked = content.begin_marked_content_with_properties(Name(b"Span"));
    marked.properties().actual_text(TextStr(&text));
    marked.finish();
    let space = SPACE * size;
    let width = advance(letter) * size - 2.0 * space;
    let height = 2.0 * DIGITS * size * 0.74 + 3.0 * space;
    let bottom = -0.12 * size;
    content.set_line_width(number(size / 24.0));
    let [left, low] = [number(pen + space), number(bottom)];
    content.rect(left, low, number(width), number(height));
    content.stroke();
    let [upper, lower] = rows(letter);
    let row = DIGITS * size * 0.74 + space;
    for (digits, base) in [(lower, bottom + space), (upper, bottom + space + row)] {
        let glyphs = digits.chars().filter_map(|digit| match find(digit, false) {
            Found::Glyph(face, glyph) => Some((digit, face, glyph)),
            _ => None,
        });
        let glyphs: Vec<_> = glyphs.collect();
        let advances = glyphs.iter().map(|(_, face, glyph)| face.advance(*glyph));
        let length = advances.sum::<f64>() * DIGITS * size;
        let codes = glyphs
            .iter()
            .flat_map(|(digit, face, glyph)| code(*digit, *face, glyph.0, fonts).to_be_bytes());
        let codes: Vec<u8> = codes.collect();
        content.begin_text();
        content.set_font(Name(Face::Regular.resource()), number(DIGITS * size));
        content.next_line(number(pen + space + (width - length) / 2.0), number(base));
        content.show(Str(&codes)).end_text();
    }
    content.end_marked_content();
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_code_point_stands_in_two_rows() {
        assert_eq!(rows('한'), ["D5", "5C"]);
        assert_eq!(rows('🖐'), ["01F", "590"]);
        assert_eq!(rows('\u{10ffff}'), ["10F", "FFF"]);
        assert!(advance('🖐') > advance('한') && advance('한') < 1.0);
    }
}
