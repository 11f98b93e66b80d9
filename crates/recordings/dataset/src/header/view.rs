//! Views: the pictures that every sample has, one per finger, eye or camera.

use serde::{Deserialize, Serialize};

use super::FramesInfo;

/// Frames of one view (a finger, an eye or a camera), and their common properties.
///
/// ```
/// let text = "name = \"left\"\ncount = 2\nwidth = 32\nheight = 24\nformat = \"gray8\"\nchannel_order = \"gray\"\n";
/// let view: taceva_dataset::ViewInfo = toml::from_str(text)?;
/// assert_eq!((view.name.as_str(), view.frames.info.width), ("left", 32));
/// # Ok::<(), toml::de::Error>(())
/// ```
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ViewInfo {
    /// Name of the view: a letter, then letters, digits or `_`.
    pub name: String,
    /// Size, colours and number of the frames of this view, and its reference frame.
    #[serde(flatten)]
    pub frames: FramesInfo,
}

impl ViewInfo {
    /// View called `name`, with its frames.
    pub fn new(name: impl Into<String>, frames: FramesInfo) -> ViewInfo {
        ViewInfo {
            name: name.into(),
            frames,
        }
    }
}
