//! Columns of a table with quality ratings of its rows.

/// Words in the name of a column that may mark bad rows.
const WORDS: [&str; 9] = [
    "quality", "flag", "valid", "status", "error", "outlier", "reject", "bad", "warning",
];

/// True if a column called `name` may mark bad rows.
///
/// ```
/// assert!(taceva_dataset::names_quality("Quality_Flags"));
/// assert!(!taceva_dataset::names_quality("operator"));
/// ```
pub fn names_quality(name: &str) -> bool {
    let folded = name.to_lowercase();
    WORDS.iter().any(|word| folded.contains(word))
}
