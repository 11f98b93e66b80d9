//! Approximate width of text in a paper column, and line breaks by this width.

use crate::escape::{LETTER, is_set_everywhere, latex as escape};

/// Column width of a two-column IEEE page: 3.5 in, in TeX points, less a small margin.
pub(crate) const COLUMN_PT: f64 = 249.0;
/// Text width of a two-column IEEE page: 7.16 in, less a small margin.
pub(super) const PAGE_PT: f64 = 510.0;
/// Greatest number of letters in a word without breaks, and in the pieces of a longer word.
const WHOLE: usize = 14;
const PIECE: usize = 4;

/// Gap between two columns of a table, in points.
pub(crate) const GAP_PT: f64 = 4.0;

/// Approximate width of `words` in points, at `size_pt` in Computer Modern, the widest default font of papers.
pub(crate) fn letters_pt(words: &str, size_pt: f64) -> f64 {
    words.chars().map(em).sum::<f64>() * size_pt
}

/// Approximate width of a letter, as a share of the font size.
fn em(letter: char) -> f64 {
    match letter {
        'i' | 'j' | 'l' | 'f' | '.' | ',' | ':' | ';' | '\'' | '|' | '!' | '[' | ']' | '('
        | ')' => 0.34,
        ' ' => 0.38,
        '0'..='9' => 0.57,
        't' | 'r' | 'I' | 's' => 0.46,
        'a' | 'c' | 'e' | 'g' | 'o' | 'z' => 0.58,
        'S' | 'E' | 'F' | 'L' | 'P' | 'J' => 0.76,
        'm' | 'w' => 0.95,
        'M' => 1.05,
        'W' => 1.17,
        '-' | '−' | '–' | '…' => 0.85,
        'a'..='z' => 0.63,
        letter if is_set_everywhere(letter) => 0.88,
        // Code point, `U+540D`.
        _ => 4.2,
    }
}

/// LaTeX text with breaks allowed inside long words, and after letters that may print as code points.
pub(super) fn breakable(text: &str) -> String {
    let mut out = String::new();
    for (at, word) in text.split(' ').enumerate() {
        if at > 0 {
            out.push(' ');
        }
        // LaTeX itself breaks a word after each hyphen.
        let is_long = word.split('-').any(|part| part.chars().count() > WHOLE);
        let mut whole = String::new();
        for letter in word.chars() {
            whole.push(letter);
            let is_point = escape(letter.encode_utf8(&mut [0; 4])).starts_with(LETTER);
            if is_point || (is_long && whole.chars().count() >= PIECE) {
                out += &escape(&whole);
                out += "\\allowbreak{}";
                whole.clear();
            }
        }
        out += &escape(&whole);
    }
    out
}

/// LaTeX text in lines of about `width_pt`, aligned to `side` (`l` or `r`). Breaks after a space or a joining character, otherwise between letters.
pub(crate) fn stacked(words: &str, width_pt: f64, size_pt: f64, side: char) -> String {
    let mut lines: Vec<String> = vec![String::new()];
    for piece in pieces(words, width_pt, size_pt) {
        let last = lines.last_mut().map_or("", |line| line.as_str());
        let joined = format!("{last}{piece}");
        match letters_pt(joined.trim_end(), size_pt) > width_pt && !last.is_empty() {
            true => lines.push(piece),
            false => {
                lines.pop();
                lines.push(joined);
            }
        }
    }
    let lines: Vec<String> = lines.iter().map(|line| escape(line.trim())).collect();
    match lines.as_slice() {
        [one] => one.clone(),
        several => format!("\\shortstack[{side}]{{{}}}", several.join("\\\\")),
    }
}

/// Splits text into pieces narrower than `width_pt` that end with a space or a joining character.
fn pieces(words: &str, width_pt: f64, size_pt: f64) -> Vec<String> {
    let mut pieces = vec![String::new()];
    let mut ends = false;
    for letter in words.chars() {
        let is_full = pieces.last().is_some_and(|piece| {
            !piece.is_empty() && letters_pt(piece, size_pt) + em(letter) * size_pt > width_pt
        });
        if ends || is_full {
            pieces.push(String::new());
        }
        if let Some(piece) = pieces.last_mut() {
            piece.push(letter);
        }
        ends = matches!(letter, ' ' | '_' | '-' | '/' | '.');
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_names_stand_on_several_lines_and_short_ones_on_one() {
        assert_eq!(stacked("GelSight", 46.0, 7.0, 'r'), "GelSight");
        assert_eq!(
            stacked("GelSight Mini 2 (ridge)", 46.0, 7.0, 'r'),
            "\\shortstack[r]{GelSight\\\\Mini 2\\\\(ridge)}"
        );
        assert_eq!(
            stacked("left_finger", 30.0, 7.0, 'l'),
            "\\shortstack[l]{left\\_\\\\finger}"
        );
        let many = stacked(&"x".repeat(40), 46.0, 7.0, 'r');
        assert_eq!(many.matches("\\\\").count(), 3, "{many}");
    }

    #[test]
    fn long_words_of_a_caption_may_break() {
        let broken = breakable("of recording_of_monday_morning");
        assert!(broken.starts_with("of reco\\allowbreak{}rdin"), "{broken}");
        let hyphen = "by 5-fold cross-validation";
        assert_eq!(breakable(hyphen), hyphen);
    }
}
