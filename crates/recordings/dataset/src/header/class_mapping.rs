//! Closed list of classes of a map.

use serde::{Deserialize, Serialize};

/// Mapping of a column of classes by an import: with another list, a number is another class.
///
/// ```
/// let text = "name = \"texture\"\nfrom = \"c\"\nnames = [\"smooth\", \"rough\"]\n";
/// let class: taceva_dataset::MappedClass = toml::from_str(text)?;
/// assert_eq!(class.names[1], "rough");
/// # Ok::<(), toml::de::Error>(())
/// ```
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct MappedClass {
    /// The attribute.
    pub name: String,
    /// The column.
    pub from: String,
    /// The list; for a long one the first names, and a digest of the others.
    pub names: Vec<String>,
}

impl MappedClass {
    /// The attribute `name`, read from the column `from` by the list `names`.
    pub fn new(name: &str, from: &str, names: Vec<String>) -> MappedClass {
        MappedClass {
            name: name.to_owned(),
            from: from.to_owned(),
            names,
        }
    }

    /// The first position with another class in `known`; a longer list with the same beginning is compatible.
    pub(super) fn other_position(&self, known: &MappedClass) -> Option<usize> {
        let mut pairs = self.names.iter().zip(&known.names);
        pairs.position(|(own, known)| own != known)
    }
}
