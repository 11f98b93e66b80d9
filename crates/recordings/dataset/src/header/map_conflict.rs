//! Conflicts between two import maps, by key.

/// Key of an import map, and its value.
pub(super) type Fact = (String, String);

/// Key of an import map whose value differs from an earlier map.
#[doc(hidden)]
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Misread {
    /// Name of the key.
    pub key: String,
    /// Value in the earlier map.
    pub own: String,
    /// Value in the new map.
    pub other: String,
    /// Remedy if the new map is right.
    pub mend: &'static str,
}

/// First fact of `new` whose value differs in `known`.
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

/// Quotes `names` for an error message.
pub(super) fn quoted(names: &[String]) -> String {
    let quoted: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    match quoted[..] {
        [] => "none".to_owned(),
        _ => quoted.join(", "),
    }
}

/// Writes a number for an error message.
pub(super) fn number(number: Option<f64>) -> String {
    number.map_or_else(|| "none".to_owned(), |number| number.to_string())
}

/// Writes a name for an error message; `none` if missing.
pub(super) fn or_none(name: Option<&str>) -> String {
    name.map_or_else(|| "none".to_owned(), |name| format!("`{name}`"))
}
