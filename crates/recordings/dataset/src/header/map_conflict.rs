//! What one map reads otherwise than another did, by the key that says so.

/// A key of a map, and what it says.
pub(super) type Fact = (String, String);

/// A key of a map that reads something otherwise than it was read before.
#[doc(hidden)]
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Misread {
    /// The key.
    pub key: String,
    /// Its value before.
    pub own: String,
    /// Its value now.
    pub other: String,
    /// What may be done about it where the map is right.
    pub mend: &'static str,
}

/// The first fact of `new` that is otherwise than the same one of `known`.
pub(super) fn differing(known: Vec<Fact>, new: Vec<Fact>, mend: &'static str) -> Option<Misread> {
    let mut pairs = known.into_iter().zip(new);
    let ((_, own), (key, other)) = pairs.find(|((_, own), (_, other))| own != other)?;
    Some(Misread {
        key,
        own,
        other,
        mend,
    })
}

/// Names as an error shows them.
pub(super) fn quoted(names: &[String]) -> String {
    let quoted: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    match quoted[..] {
        [] => "none".to_owned(),
        _ => quoted.join(", "),
    }
}

/// A number as an error shows it.
pub(super) fn number(number: Option<f64>) -> String {
    number.map_or_else(|| "none".to_owned(), |number| number.to_string())
}

/// A name as an error shows it, or that there is none.
pub(super) fn or_none(name: Option<&str>) -> String {
    name.map_or_else(|| "none".to_owned(), |name| format!("`{name}`"))
}
