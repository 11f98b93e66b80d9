//! Finds the frames of an import: files, arrays or clips.

use taceva_dataset::ChannelOrder;

/// Attribute with the name of the frame without contact of each row, if this frame differs between rows.
const REFERENCE_ATTRIBUTE: &str = "reference";

/// Attribute with the name of the frame without contact of `view` for each row, if this frame differs between rows.
pub(crate) fn reference_attribute(view: Option<&str>) -> String {
    match view {
        None => REFERENCE_ATTRIBUTE.to_owned(),
        Some(view) => format!("{REFERENCE_ATTRIBUTE}_{view}"),
    }
}

/// Description of the picture index if the map names no index column.
pub(crate) const OWN_ROW: &str = "the row of its table";

/// Location and colour order of the frames of one view.
///
/// ```
/// use taceva_dataset::ChannelOrder;
/// use taceva_import::{FrameMap, FrameNames};
///
/// let frames = FrameMap::new(FrameNames::Column("file".into()), ChannelOrder::Gray);
/// assert_eq!((frames.folder, frames.reference), (None, None));
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct FrameMap {
    /// View of the frames, such as a finger or an eye; `None` if a row has only one picture.
    pub view: Option<String>,
    /// Rule by which a row names its frame.
    pub names: FrameNames,
    /// Base folder of file names, relative to the source folder; `None` for the folder of the table.
    pub folder: Option<String>,
    /// Colour order in the files.
    pub channel_order: ChannelOrder,
    /// Frame without contact, relative to the source folder; `None` if unknown.
    pub reference: Option<String>,
    /// Column that names the frame without contact of each row, relative to `folder`. If all rows name the same frame, it becomes the frame without contact of
    /// the recording. Otherwise the names become the attribute `reference`.
    pub reference_column: Option<String>,
    /// Number of the frame without contact, from 0, in the only clip or array that contains the frames.
    pub reference_frame: Option<u64>,
}

impl FrameMap {
    /// Frames in `channel_order`, in files relative to the folder of the table. The frame without contact is unknown.
    pub fn new(names: FrameNames, channel_order: ChannelOrder) -> FrameMap {
        FrameMap {
            view: None,
            names,
            folder: None,
            channel_order,
            reference: None,
            reference_column: None,
            reference_frame: None,
        }
    }
}

/// Rule by which a row names its frame.
///
/// ```
/// use taceva_import::FrameNames;
///
/// // A row whose column `n` holds 7 has the frame images/image_7.png.
/// let names = FrameNames::Pattern("images/image_{n}.png".into());
/// assert_ne!(names, FrameNames::Column("n".into()));
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum FrameNames {
    /// Column with the path of the frame.
    Column(String),
    /// Path pattern in which `{column}` is replaced by the cell of that column.
    Pattern(String),
    /// Frames in one array.
    Array(ArrayFrames),
    /// Column with the bytes of a PNG, JPEG or TIFF file.
    Bytes(String),
    /// Frames of a clip.
    Video(VideoFrames),
}

impl FrameNames {
    /// True if the frames are in the file of the table.
    pub(crate) fn is_in_table(&self) -> bool {
        match self {
            FrameNames::Bytes(_) => true,
            FrameNames::Array(array) => array.file.is_none(),
            FrameNames::Column(_) | FrameNames::Pattern(_) | FrameNames::Video(_) => false,
        }
    }
}

/// Frames in one array.
///
/// ```
/// use taceva_import::{ArrayFrames, FrameNames};
///
/// let names = FrameNames::Array(ArrayFrames::new("frames.npy", "frame"));
/// assert!(matches!(names, FrameNames::Array(array) if array.index == "frame"));
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ArrayFrames {
    /// File relative to the source folder, with `{column}` replaced by the cell of that column; `None` for the file of the table.
    pub file: Option<String>,
    /// Array in the file; `None` if the file contains only one array.
    pub path: Option<String>,
    /// Column with the position in the array, from 0; `row` is the row number.
    pub index: String,
    /// Axis order; `None` to infer it from the axis lengths.
    pub layout: Option<ArrayLayout>,
    /// Values of black and full scale, with the bits per stored pixel; `None` for integers of 8 or 16 bits.
    pub range: Option<PixelRange>,
}

/// Axis order of an array of frames.
///
/// ```
/// use taceva_import::ArrayLayout;
///
/// assert_eq!(ArrayLayout::Nchw.name(), "nchw");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum ArrayLayout {
    /// Frame, row, column, colour.
    Nhwc,
    /// Frame, row, column.
    Nhw,
    /// Frame, colour, row, column.
    Nchw,
}

impl ArrayLayout {
    /// Name of the layout in a map.
    pub const fn name(self) -> &'static str {
        match self {
            ArrayLayout::Nhwc => "nhwc",
            ArrayLayout::Nhw => "nhw",
            ArrayLayout::Nchw => "nchw",
        }
    }
}

/// Linear mapping from numbers to pixels of 8 or 16 bits. `black` becomes 0 and `full` becomes the greatest pixel value. Results are rounded.
///
/// ```
/// use taceva_import::PixelRange;
///
/// let range = PixelRange::new([0.0, 1.0], 8).ok_or("a range")?;
/// assert_eq!((range.pixel(0.5), range.pixel(1.5)), (Some(128), None));
/// # Ok::<(), &str>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PixelRange {
    black: f64,
    full: f64,
    bits: u8,
}

impl PixelRange {
    /// Range from black to full scale; `bits` must be 8 or 16. `None` for other bits, and if the range is empty or not finite.
    pub fn new([black, full]: [f64; 2], bits: u8) -> Option<PixelRange> {
        let is_range = black.is_finite() && full.is_finite() && (full - black).abs() > 0.0;
        (is_range && matches!(bits, 8 | 16)).then_some(PixelRange { black, full, bits })
    }

    /// Bits per stored pixel.
    pub fn bits(&self) -> u8 {
        self.bits
    }

    /// Values of black and full scale.
    pub fn ends(&self) -> [f64; 2] {
        [self.black, self.full]
    }

    /// Pixel of `number`; `None` if the number is outside the range.
    pub fn pixel(&self, number: f64) -> Option<u16> {
        let share = (number - self.black) / (self.full - self.black);
        let most = if self.bits == 8 { 255.0 } else { 65_535.0 };
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a whole number from 0 to `most`"
        )]
        let pixel = (share * most).round() as u16;
        (0.0..=1.0).contains(&share).then_some(pixel)
    }
}

impl ArrayFrames {
    /// Frames of `file`, which contains a single array, such as a `.npy` file. The column `index` contains the position in the array.
    pub fn new(file: impl Into<String>, index: impl Into<String>) -> ArrayFrames {
        ArrayFrames {
            file: Some(file.into()),
            path: None,
            index: index.into(),
            layout: None,
            range: None,
        }
    }
}

/// Frames of a clip.
///
/// ```
/// use taceva_import::{FrameNames, VideoFrames};
///
/// let names = FrameNames::Video(VideoFrames::new("clip_{run}.mp4", "row"));
/// assert!(matches!(names, FrameNames::Video(video) if video.index == "row"));
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct VideoFrames {
    /// Clip relative to the source folder, with `{column}` replaced by the cell of that column. For a LeRobot dataset, the name of the feature.
    pub file: String,
    /// Column with the frame number in display order, from 0; `row` is the row number.
    pub index: String,
    /// Distances of black and full scale in a depth map, mm; `None` for pictures, and for a depth map in whole millimetres.
    pub range: Option<PixelRange>,
}

impl VideoFrames {
    /// Frames of the clip `file`. The column `index` contains the frame number.
    pub fn new(file: impl Into<String>, index: impl Into<String>) -> VideoFrames {
        VideoFrames {
            file: file.into(),
            index: index.into(),
            range: None,
        }
    }
}
