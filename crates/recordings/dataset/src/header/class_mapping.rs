//! Closed list of classes in an import map.

use serde::{Deserialize, Serialize};

/// Mapping of a column of classes by an import. A number denotes a different class in a different list.
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
    /// Name of the attribute.
    pub name: String,
    /// Name of the source column.
    pub from: String,
    /// Names of the classes. Long lists are stored as the first names and a digest of the other names.
    pub names: Vec<String>,
}

impl MappedClass {
    /// Classes in the attribute `name`, read from the column `from` with the list `names`.
    pub fn new(name: &str, from: &str, names: Vec<String>) -> MappedClass {
        MappedClass {
            name: name.to_owned(),
            from: from.to_owned(),
            names,
        }
    }

    /// First position at which the classes differ; `None` if one list is a prefix of the other.
    pub(super) fn other_position(&self, known: &MappedClass) -> Option<usize> {
        let mut pairs = self.names.iter().zip(&known.names);
        pairs.position(|(own, known)| own != known)
    }
}
