//! Columns of a table that rate its rows.

/// Words in the name of a column that may say which rows are bad.
const WORDS: [&str; 9] = [
    "quality", "flag", "valid", "status", "error", "outlier", "reject", "bad", "warning",
];

/// Whether a column called `name` may say which rows are bad.
///
/// ```
/// assert!(taceva_dataset::names_quality("Quality_Flags"));
/// assert!(!taceva_dataset::names_quality("operator"));
/// ```
pub fn names_quality(name: &str) -> bool {
    let folded = name.to_lowercase();
    WORDS.iter().any(|word| folded.contains(word))
}
