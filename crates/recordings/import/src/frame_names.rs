//! Where the frames of an import are.

use taceva_dataset::ChannelOrder;

/// The attribute that says which frame without contact a row names, where rows name different ones.
const REFERENCE_ATTRIBUTE: &str = "reference";

/// The attribute that says which frame without contact of `view` a row names, where rows name different ones.
pub(crate) fn reference_attribute(view: Option<&str>) -> String {
    match view {
        None => REFERENCE_ATTRIBUTE.to_owned(),
        Some(view) => format!("{REFERENCE_ATTRIBUTE}_{view}"),
    }
}

/// The position of a picture where a map names no column for it: the row in its own table, whatever columns that has.
pub(crate) const OWN_ROW: &str = "the row of its table";

/// Where the frames are.
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
    /// The view that they are of, such as a finger or an eye; `None` where a row has one picture alone.
    pub view: Option<String>,
    /// How a row names its frame.
    pub names: FrameNames,
    /// The folder that file names are relative to, relative to the source folder; `None`: that of the table.
    pub folder: Option<String>,
    /// The order of the colours in the files.
    pub channel_order: ChannelOrder,
    /// The frame without contact, relative to the source folder; `None` if none is known.
    pub reference: Option<String>,
    /// The column that names the frame without contact of each row, relative to `folder` as frames are: kept as that of the recording where all
    /// rows name the same, else as the attribute `reference`.
    pub reference_column: Option<String>,
}

impl FrameMap {
    /// Frames in files relative to the folder of the table, with colours in `channel_order` and without a frame without contact.
    pub fn new(names: FrameNames, channel_order: ChannelOrder) -> FrameMap {
        FrameMap {
            view: None,
            names,
            folder: None,
            channel_order,
            reference: None,
            reference_column: None,
        }
    }
}

/// How a row names its frame.
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
    /// A column holds the path.
    Column(String),
    /// A path in which `{column}` stands for the cell of that column.
    Pattern(String),
    /// Frames in one array.
    Array(ArrayFrames),
    /// The column of the table that holds the bytes of a PNG, JPEG or TIFF file.
    Bytes(String),
    /// Frames of a clip.
    Video(VideoFrames),
}

impl FrameNames {
    /// Whether the frames are in the file of the table.
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
    /// The file, relative to the source folder, in which `{column}` stands for the cell of that column; `None`: that of the table.
    pub file: Option<String>,
    /// The array in it; `None` where the file holds one alone.
    pub path: Option<String>,
    /// The column that holds the position in the array, from 0; `row` is the number of the row.
    pub index: String,
    /// What the axes are; `None` where their lengths tell.
    pub layout: Option<ArrayLayout>,
    /// The numbers of black and of full, and the bits that a pixel is kept in; `None` of pixels that are whole numbers of 8 or 16 bits.
    pub range: Option<PixelRange>,
}

/// What the axes of an array of frames are.
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
    /// The word for it in a map.
    pub const fn name(self) -> &'static str {
        match self {
            ArrayLayout::Nhwc => "nhwc",
            ArrayLayout::Nhw => "nhw",
            ArrayLayout::Nchw => "nchw",
        }
    }
}

/// How numbers of any type become pixels: `black` 0, `full` the greatest number of `bits`, what is between in proportion and rounded.
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
    /// From the number of black to that of full in 8 or 16 bits; `None` if they are no range, or the bits are others.
    pub fn new([black, full]: [f64; 2], bits: u8) -> Option<PixelRange> {
        let is_range = black.is_finite() && full.is_finite() && (full - black).abs() > 0.0;
        (is_range && matches!(bits, 8 | 16)).then_some(PixelRange { black, full, bits })
    }

    /// The bits that a pixel is kept in.
    pub fn bits(&self) -> u8 {
        self.bits
    }

    /// The numbers of black and of full.
    pub fn ends(&self) -> [f64; 2] {
        [self.black, self.full]
    }

    /// The pixel of `number`; `None` outside of the range.
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
    /// The frames in `file`, which holds one array alone, such as a `.npy` file; the column `index` holds the position in the array.
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
    /// The clip, relative to the source folder, in which `{column}` stands for the cell of that column; of a LeRobot dataset the name of
    /// the feature.
    pub file: String,
    /// The column that holds the number of the frame in the order in which they are shown, from 0; `row` is the number of the row.
    pub index: String,
    /// The distances of black and of full in a depth map, mm; `None` of pictures, and of a depth map in whole millimetres.
    pub range: Option<PixelRange>,
}

impl VideoFrames {
    /// The frames of the clip `file`; the column `index` holds the number of the frame.
    pub fn new(file: impl Into<String>, index: impl Into<String>) -> VideoFrames {
        VideoFrames {
            file: file.into(),
            index: index.into(),
            range: None,
        }
    }
}
