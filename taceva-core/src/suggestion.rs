//! Suggestions for misspelt words: the known word with the smallest edit distance.

/// Candidate with the fewest edits from `wrong`, or the first of several such candidates. `None` if the edits exceed a third of the letters of the
/// longer word.
///
/// An edit inserts, removes or replaces a letter, or swaps two neighbours (optimal string alignment). Upper and lower case are equal.
///
/// ```
/// assert_eq!(taceva_core::nearest("depht", ["depth", "width"]), Some("depth"));
/// assert_eq!(taceva_core::nearest("colour", ["depth", "width"]), None);
/// ```
pub fn nearest<'a>(wrong: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let wrong: Vec<char> = wrong.to_lowercase().chars().collect();
    if wrong.len() > LONGEST {
        return None;
    }
    candidates
        .into_iter()
        .map(|candidate| {
            let letters: Vec<char> = candidate.to_lowercase().chars().collect();
            let longer = wrong.len().max(letters.len());
            (edits(&wrong, &letters), longer, candidate)
        })
        .filter(|(edits, longer, _)| edits * 3 <= *longer)
        .min_by_key(|(edits, _, _)| *edits)
        .map(|(_, _, candidate)| candidate)
}

/// Text `did you mean …?` with the word of `accepted` nearest to `wrong`. Without a near word, the text lists all of `accepted`.
///
/// ```
/// use taceva_core::suggestion;
/// assert_eq!(suggestion("depht", &["depth", "width"]), "did you mean `depth`?");
/// assert_eq!(suggestion("colour", &["depth", "width"]), "expected one of `depth`, `width`");
/// ```
pub fn suggestion(wrong: &str, accepted: &[&str]) -> String {
    match nearest(wrong, accepted.iter().copied()) {
        Some(nearest) => format!("did you mean `{nearest}`?"),
        None => format!("expected one of `{}`", accepted.join("`, `")),
    }
}

/// Greatest length of a word with suggestions, letters. A longer word is not a typing mistake, and the run time grows with the square of the length.
const LONGEST: usize = 256;

fn edits(first: &[char], second: &[char]) -> usize {
    let width = second.len() + 1;
    let mut table = vec![0; (first.len() + 1) * width];
    for row in 0..=first.len() {
        for column in 0..width {
            table[row * width + column] = if row == 0 || column == 0 {
                row + column
            } else {
                let (letter, other) = (first[row - 1], second[column - 1]);
                let replaced = table[(row - 1) * width + column - 1] + usize::from(letter != other);
                let removed = table[(row - 1) * width + column] + 1;
                let inserted = table[row * width + column - 1] + 1;
                let swapped = row > 1
                    && column > 1
                    && letter == second[column - 2]
                    && first[row - 2] == other;
                let swapped = match swapped {
                    true => table[(row - 2) * width + column - 2] + 1,
                    false => usize::MAX,
                };
                replaced.min(removed).min(inserted).min(swapped)
            };
        }
    }
    table[first.len() * width + second.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_typing_mistake_finds_its_word_and_a_stranger_finds_none() {
        let words = ["sim/gelsight", "sim/gelsight-wm", "sim/magictac", "seed"];
        assert_eq!(nearest("sim/gelsihgt", words), Some("sim/gelsight"));
        assert_eq!(nearest("SIM/GelSight-W", words), Some("sim/gelsight-wm"));
        assert_eq!(nearest("sede", words), Some("seed"));
        assert_eq!(nearest("robot", words), None);
        assert_eq!(nearest("", words), None);
        assert_eq!(nearest(&"s".repeat(100_000), words), None);
    }

    #[test]
    fn edits_are_counted_as_by_hand() {
        let count = |first: &str, second: &str| {
            let letters = |word: &str| word.chars().collect::<Vec<_>>();
            edits(&letters(first), &letters(second))
        };
        assert_eq!(count("kitten", "sitting"), 3);
        assert_eq!(count("depht", "depth"), 1);
        assert_eq!(count("", "abc"), 3);
        assert_eq!(count("same", "same"), 0);
    }
}
