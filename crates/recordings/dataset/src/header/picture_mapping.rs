//! Mapping of pictures to rows, and of values to pixels.

use serde::{Deserialize, Serialize};

use super::map_conflict::{Fact, number, or_none};

/// Mapping of pictures by an import. A different range or index column would select different pictures.
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
    /// Key of the source: `column`, `pattern`, `array`, `bytes` or `video`.
    pub by: String,
    /// Column, pattern, array, or clip that contains the pictures; empty for the only array of a file.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub from: String,
    /// Column with the index of the picture in an array or clip; `None` if the row number is the index.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub index: Option<String>,
    /// Axes of an array: `nhwc`, `nhw` or `nchw`, if the map states them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub layout: Option<String>,
    /// Values that become black and full scale, in this order; `None` if values are not converted.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub range: Option<[f64; 2]>,
    /// Bits per pixel after values in `range` are converted to pixels; `None` if values are not converted.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bits: Option<u8>,
    /// Name of the view, if samples have several pictures.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub view: Option<String>,
}

impl MappedPictures {
    /// Pictures by the key `by` and the source `from`, indexed by row number.
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

    /// True if both mappings have the same source: arrays with the same name, or any clips, because clip names differ between recordings.
    pub(super) fn is_of(&self, known: &MappedPictures) -> bool {
        self.by == known.by
            && self.view == known.view
            && match self.by.as_str() {
                "array" => self.from == known.from,
                "video" => true,
                _ => false,
            }
    }

    /// Settings that determine the pixels and their rows, by the keys of an import map.
    pub(super) fn facts(&self) -> Vec<Fact> {
        // Other layouts are distinguished by the lengths of the axes.
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
