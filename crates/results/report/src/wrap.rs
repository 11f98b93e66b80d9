//! Wraps text to a width.

/// Additional indent of lines after the first line, in characters.
const HANGING: usize = 4;

/// Wraps text to lines of at most `width` characters, indented by `indent`. Lines after the first have 4 more spaces. Breaks a word that is longer than a line.
///
/// Each line ends with a line feed.
pub(crate) fn wrapped(text: &str, width: usize, indent: usize) -> String {
    let room = width.saturating_sub(indent + HANGING).max(1);
    let mut out = String::new();
    let mut line = " ".repeat(indent);
    let mut is_empty = true;
    for word in text.split(' ').filter(|word| !word.is_empty()) {
        for (at, piece) in pieces(word, room).iter().enumerate() {
            let is_full = line.chars().count() + 1 + piece.chars().count() > width;
            if !is_empty && (at > 0 || is_full) {
                out += &line;
                out.push('\n');
                line = " ".repeat(indent + HANGING);
                is_empty = true;
            }
            if !is_empty {
                line.push(' ');
            }
            line += piece;
            is_empty = false;
        }
    }
    out + line.trim_end() + "\n"
}

/// Splits `word` into pieces of at most `room` characters.
fn pieces(word: &str, room: usize) -> Vec<String> {
    let letters: Vec<char> = word.chars().collect();
    let pieces = letters.chunks(room);
    pieces.map(|piece| piece.iter().collect()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_stay_whole_where_a_line_has_room_for_them() {
        assert_eq!(wrapped("one two three", 9, 0), "one two\n    three\n");
        assert_eq!(wrapped("one two", 9, 2), "  one two\n");
        assert_eq!(wrapped("", 9, 0), "\n");
    }

    #[test]
    fn a_word_longer_than_a_line_is_broken_and_nothing_is_lost() {
        let text = wrapped("a unbreakable b", 8, 0);
        assert!(text.lines().all(|line| line.chars().count() <= 8), "{text}");
        assert_eq!(text.replace([' ', '\n'], ""), "aunbreakableb");
    }
}
