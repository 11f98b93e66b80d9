//! Where the frames of an import are.

use crate::decode::ChannelOrder;

/// Where the frames are.
///
/// ```
/// use taceva_dataset::{ChannelOrder, FrameMap, FrameNames};
///
/// let frames = FrameMap::new(FrameNames::Column("file".into()), ChannelOrder::Gray);
/// assert_eq!((frames.folder, frames.reference), (None, None));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct FrameMap {
    /// How a row names its frame.
    pub names: FrameNames,
    /// The folder that file names are relative to, relative to the source folder; `None`: that of the table.
    pub folder: Option<String>,
    /// The order of the colours in the files.
    pub channel_order: ChannelOrder,
    /// The frame without contact, relative to the source folder; `None` if none is known.
    pub reference: Option<String>,
}

impl FrameMap {
    /// Frames in files relative to the folder of the table, with colours in `channel_order` and without a frame without contact.
    pub fn new(names: FrameNames, channel_order: ChannelOrder) -> FrameMap {
        FrameMap {
            names,
            folder: None,
            channel_order,
            reference: None,
        }
    }
}

/// How a row names its frame.
///
/// ```
/// use taceva_dataset::FrameNames;
///
/// // A row whose column `n` holds 7 has the frame images/image_7.png.
/// let names = FrameNames::Pattern("images/image_{n}.png".into());
/// assert_ne!(names, FrameNames::Column("n".into()));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum FrameNames {
    /// A column holds the path.
    Column(String),
    /// A path in which `{column}` stands for the cell of that column.
    Pattern(String),
    /// Frames in one array.
    Array(ArrayFrames),
}

/// Frames in one array.
///
/// ```
/// use taceva_dataset::{ArrayFrames, FrameNames};
///
/// let names = FrameNames::Array(ArrayFrames::new("frames.npy", "frame"));
/// assert!(matches!(names, FrameNames::Array(array) if array.index == "frame"));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct ArrayFrames {
    /// The `.npy` file, relative to the source folder.
    pub file: String,
    /// The column that holds the position in the array, from 0.
    pub index: String,
}

impl ArrayFrames {
    /// The frames in the `.npy` file `file`; the column `index` holds the position in the array.
    pub fn new(file: impl Into<String>, index: impl Into<String>) -> ArrayFrames {
        ArrayFrames {
            file: file.into(),
            index: index.into(),
        }
    }
}
