//! Texts in PDF: Helvetica where it has the letter, Symbol for the few that it lacks.

use crate::figure::canvas::{Anchor, Label};

/// Widths of Helvetica from the space to the tilde, in thousandths of its size.
const WIDTHS: [u16; 95] = [
    278, 278, 355, 556, 556, 889, 667, 191, 333, 333, 389, 584, 278, 333, 278, 278, 556, 556, 556,
    556, 556, 556, 556, 556, 556, 556, 278, 278, 584, 584, 584, 556, 1015, 667, 667, 722, 722, 667,
    611, 778, 722, 278, 500, 667, 556, 833, 722, 778, 667, 778, 722, 667, 611, 722, 667, 944, 667,
    667, 611, 278, 278, 278, 469, 556, 333, 556, 556, 500, 556, 556, 278, 556, 556, 222, 222, 500,
    222, 833, 556, 556, 556, 556, 333, 500, 278, 556, 500, 722, 500, 500, 500, 334, 260, 334, 584,
];

/// A byte of a font.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Glyph {
    Helvetica(u8),
    Symbol(u8),
}

fn glyph(letter: char) -> Glyph {
    match letter {
        ' '..='~' => Glyph::Helvetica(u8::try_from(letter).unwrap_or(b'?')),
        '\u{a0}'..='\u{ff}' => Glyph::Helvetica(u8::try_from(letter).unwrap_or(b'?')),
        '…' => Glyph::Helvetica(0x85),
        // The en dash is as wide as a minus.
        '–' | '−' => Glyph::Helvetica(0x96),
        'ε' => Glyph::Symbol(0x65),
        'σ' => Glyph::Symbol(0x73),
        '↑' => Glyph::Symbol(0xad),
        '↓' => Glyph::Symbol(0xaf),
        _ => Glyph::Helvetica(b'?'),
    }
}

fn width(glyph: Glyph) -> f64 {
    let thousandths = match glyph {
        Glyph::Helvetica(byte) => {
            let place = usize::from(byte).checked_sub(32);
            place
                .and_then(|place| WIDTHS.get(place))
                .copied()
                .unwrap_or(556)
        }
        Glyph::Symbol(_) => 520,
    };
    f64::from(thousandths) / 1000.0
}

/// The operators that print `label` in `colour` on a page of `height`.
pub(super) fn label(label: &Label, height: f64, colour: &str) -> String {
    let glyphs: Vec<Glyph> = label.text.chars().map(glyph).collect();
    let length = glyphs.iter().map(|glyph| width(*glyph)).sum::<f64>() * label.size;
    let back = match label.anchor {
        Anchor::Start => 0.0,
        Anchor::Middle => length / 2.0,
        Anchor::End => length,
    };
    let [x, y] = [label.at[0], height - label.at[1]];
    let matrix = match label.upwards {
        true => format!("0 1 -1 0 {x:.2} {:.2}", y - back),
        false => format!("1 0 0 1 {:.2} {y:.2}", x - back),
    };
    let mut out = format!("BT {colour} {matrix} Tm ");
    let font = |glyph: &Glyph| match (glyph, label.bold) {
        (Glyph::Symbol(_), _) => 2,
        (_, true) => 1,
        (_, false) => 0,
    };
    for run in glyphs.chunk_by(|left, right| font(left) == font(right)) {
        let bytes = run.iter().map(|glyph| match glyph {
            Glyph::Helvetica(byte) | Glyph::Symbol(byte) => format!("{byte:02x}"),
        });
        let font = run.first().map_or(0, font);
        out += &format!(
            "/F{font} {} Tf <{}> Tj ",
            label.size,
            bytes.collect::<String>()
        );
    }
    out + "ET\n"
}

/// A text of the file itself, in UTF-16 with its mark.
pub(super) fn literal(text: &str) -> String {
    let units = text.encode_utf16().map(|unit| format!("{unit:04x}"));
    format!("<feff{}>", units.collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_that_helvetica_lacks_come_from_symbol() {
        let at_the_end = Label::new([100.0, 10.0], "SR(ε) ↑", Anchor::End);
        let printed = label(&at_the_end, 200.0, "0 0 0 rg");
        // S 667, R 722, parentheses 333 each, space 278, two of Symbol: 3373 thousandths of 11.
        assert!(printed.starts_with("BT 0 0 0 rg 1 0 0 1 62.9"), "{printed}");
        assert!(printed.contains("/F2 11 Tf <65> Tj") && printed.contains("/F2 11 Tf <ad> Tj"));
    }
}
