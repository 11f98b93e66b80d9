//! How a map found the picture of each row, and what numbers became which pixels.

use serde::{Deserialize, Serialize};

use super::map_conflict::{Fact, number, or_none};

/// How the map of an import read pictures: the same numbers in another range, or counted by another column, are other pictures.
///
/// ```
/// let text = "by = \"array\"\nfrom = \"/rgb\"\nindex = \"n\"\nrange = [0.0, 1.0]\nbits = 8\n";
/// let pictures: taceva_dataset::MappedPictures = toml::from_str(text)?;
/// assert_eq!((pictures.from.as_str(), pictures.bits), ("/rgb", Some(8)));
/// # Ok::<(), toml::de::Error>(())
/// ```
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MappedPictures {
    /// The key that says where they are: `column`, `pattern`, `array`, `bytes` or `video`.
    pub by: String,
    /// The column, the pattern, the array in its file, or the clip; empty of the only array of a file.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub from: String,
    /// The column of the position in an array or a clip; absent where it is that of the row in its table.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub index: Option<String>,
    /// `nhwc`, `nhw` or `nchw`, where the map says what the axes of an array are.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub layout: Option<String>,
    /// The numbers of black and of full.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub range: Option<[f64; 2]>,
    /// The bits of a pixel that numbers in a range became.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bits: Option<u8>,
    /// The view that they are of, where samples have several pictures.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub view: Option<String>,
}

impl MappedPictures {
    /// Pictures that the key `by` names by `from`, each with the number of its row.
    pub fn new(by: &str, from: &str) -> MappedPictures {
        MappedPictures {
            by: by.to_owned(),
            from: from.to_owned(),
            index: None,
            layout: None,
            range: None,
            bits: None,
            view: None,
        }
    }

    /// Whether both read the same: arrays of one name, or clips, which are called otherwise in every recording.
    pub(super) fn is_of(&self, known: &MappedPictures) -> bool {
        self.by == known.by
            && self.view == known.view
            && match self.by.as_str() {
                "array" => self.from == known.from,
                "video" => true,
                _ => false,
            }
    }

    /// What decides the pixels and whose they are, by the keys of a map.
    pub(super) fn facts(&self) -> Vec<Fact> {
        // Of the others the lengths of the axes tell which it is.
        let layout = match self.layout.as_deref() {
            Some("nchw") => "nchw",
            _ => "nhwc or nhw",
        };
        let range = self.range.map_or_else(
            || "none".to_owned(),
            |[black, full]| format!("[{black}, {full}]"),
        );
        vec![
            (
                "frame.index".to_owned(),
                or_none(Some(self.index.as_deref().unwrap_or("row"))),
            ),
            ("frame.layout".to_owned(), layout.to_owned()),
            ("frame.range".to_owned(), range),
            ("frame.bits".to_owned(), number(self.bits.map(f64::from))),
        ]
    }
}
