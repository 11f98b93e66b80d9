//! Doc comments that begin with a clause instead of a noun.

use std::collections::BTreeMap;

use super::sources::Source;

/// First words of comments that begin with a clause. Such a comment paraphrases a thing instead of naming it.
const CLAUSES: [&str; 12] = [
    "How", "It", "Its", "Of", "That", "Those", "What", "Where", "Whether", "Which", "Whoever",
    "Why",
];

/// Doc comments of one package.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Documentation {
    /// Number of doc comments in product code.
    pub comments: usize,
    /// Number of comments that begin with a clause.
    pub clauses: usize,
}

impl Documentation {
    /// Share of comments that begin with a clause, in per cent.
    pub fn percent(self) -> f64 {
        let count = |n: usize| u32::try_from(n).map_or(f64::INFINITY, f64::from);
        match self.comments {
            0 => 0.0,
            comments => 100.0 * count(self.clauses) / count(comments),
        }
    }
}

/// Doc comments of each package.
pub fn documentation(sources: &[Source]) -> BTreeMap<&str, Documentation> {
    let mut found: BTreeMap<&str, Documentation> = BTreeMap::new();
    for source in sources.iter().filter(|source| source.is_product()) {
        let of_package = found.entry(&source.package).or_default();
        for first in first_lines(&source.text) {
            let word = first.split(|letter: char| !letter.is_alphabetic()).next();
            of_package.comments += 1;
            of_package.clauses += usize::from(word.is_some_and(|word| CLAUSES.contains(&word)));
        }
    }
    found
}

/// First line of each doc comment.
fn first_lines(text: &str) -> Vec<&str> {
    let (mut found, mut is_within) = (Vec::new(), false);
    for line in text.lines().map(str::trim_start) {
        let comment = line
            .strip_prefix("//!")
            .or_else(|| line.strip_prefix("///"));
        if let Some(comment) = comment.filter(|_| !is_within) {
            found.push(comment.trim_start());
        }
        is_within = comment.is_some();
    }
    found
}

#[cfg(test)]
mod tests {
    use super::first_lines;

    #[test]
    fn each_block_counts_once() {
        let text = "//! What it is.\n//! More.\n\n/// Which one.\n/// More.\nfn a() {}\n    /// A frame.\n";
        assert_eq!(first_lines(text), ["What it is.", "Which one.", "A frame."]);
    }
}
