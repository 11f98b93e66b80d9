//! The closed list by which a map read a column of classes.

use serde::{Deserialize, Serialize};

/// How the map of an import read a column of classes: a number in a column is another class by another list.
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
    /// The list; of a long one the first names, and a digest of the others.
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

    /// The first position that means another class in `known`; a list that goes on where the other ends means the same.
    pub(super) fn other_position(&self, known: &MappedClass) -> Option<usize> {
        let mut pairs = self.names.iter().zip(&known.names);
        pairs.position(|(own, known)| own != known)
    }
}
