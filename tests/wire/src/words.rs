//! Words of a line of G-code: letters with numbers.

/// Words of a line, with or without blanks between them.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Words(Vec<Word>);

#[derive(Clone, Copy, Debug, PartialEq)]
struct Word {
    letter: char,
    number: f64,
}

impl Words {
    /// Parses a line such as `G53 G1 X1.5` or `G53G01X1.5`; `None` if a letter has no number.
    pub(crate) fn read(line: &str) -> Option<Words> {
        let code = line.split([';', '(']).next().unwrap_or_default();
        let text: String = code
            .chars()
            .filter(|letter| !letter.is_whitespace())
            .collect();
        let mut words = Vec::new();
        let mut rest = text.as_str();
        while let Some(letter) = rest.chars().next() {
            let behind = &rest[letter.len_utf8()..];
            let end = behind.find(|letter: char| letter.is_alphabetic());
            let (number, after) = behind.split_at(end.unwrap_or(behind.len()));
            words.push(Word {
                letter: letter.to_ascii_uppercase(),
                number: number.parse().ok()?,
            });
            rest = after;
        }
        Some(Words(words))
    }

    /// Number after `letter`, if the line has it.
    pub(crate) fn number(&self, letter: char) -> Option<f64> {
        let word = self.0.iter().find(|word| word.letter == letter)?;
        Some(word.number)
    }

    /// True if the line contains the command `letter` with `number`, which may be written as `G1` or `G01`.
    pub(crate) fn has(&self, letter: char, number: u32) -> bool {
        let wanted = f64::from(number);
        let mut words = self.0.iter().filter(|word| word.letter == letter);
        words.any(|word| (word.number - wanted).abs() < 1e-9)
    }

    /// Numbers of all words that begin with `letter`.
    pub(crate) fn all(&self, letter: char) -> impl Iterator<Item = f64> {
        let words = self.0.iter().filter(move |word| word.letter == letter);
        words.map(|word| word.number)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_the_same_with_and_without_blanks() {
        let spaced = Words::read("G53 G1 X-1.5 Y2 Z0 F600 ; down").expect("words");
        assert_eq!(Words::read("g53g01x-1.5y2.z0f600"), Some(spaced.clone()));
        assert!(spaced.has('G', 1) && spaced.has('G', 53) && !spaced.has('G', 0));
        assert_eq!(
            spaced.number('X').map(f64::to_bits),
            Some((-1.5_f64).to_bits())
        );
        assert_eq!((spaced.all('G').count(), spaced.number('E')), (2, None));
        assert_eq!(Words::read("G1 X"), None);
        assert_eq!(Words::read("1X"), None);
    }
}
