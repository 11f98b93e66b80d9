//! Frames as arrays of `ndarray`.

use ndarray::{Array3, Array4};
use taceva_core::{Frame, FrameInfo};

use crate::dataset::{Dataset, Pass};
use crate::error::DatasetError;

/// Pixels of one frame.
///
/// # Shapes
/// Height × width × channels, in standard (row-major) layout; one channel for gray, three for red, green and blue.
/// # Units
/// Camera steps: 0 to 255, or 0 to 65,535.
///
/// ```
/// use taceva_core::{Frame, FrameInfo, PixelFormat};
/// use taceva_dataset::FrameArray;
/// let info = FrameInfo { width: 2, height: 1, format: PixelFormat::Rgb8 };
/// let FrameArray::U8(pixels) = FrameArray::from(Frame::new(info, vec![1, 2, 3, 4, 5, 6])?) else {
///     return Err("8 bits".into());
/// };
/// assert_eq!((pixels.dim(), pixels[[0, 1, 2]]), ((1, 2, 3), 6));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum FrameArray {
    /// Pixels with 8 bits per value.
    U8(Array3<u8>),
    /// Pixels with 16 bits per value.
    U16(Array3<u16>),
}

/// Pixels of several frames of the same size.
///
/// # Shapes
/// Frames × height × width × channels, in standard (row-major) layout; one channel for gray, three for red, green and blue.
/// # Units
/// Camera steps: 0 to 255, or 0 to 65,535.
///
/// ```
/// use taceva_core::{Frame, FrameInfo, PixelFormat};
/// use taceva_dataset::FrameArrays;
/// let info = FrameInfo { width: 1, height: 1, format: PixelFormat::Gray16 };
/// let frames = [Frame::new(info, vec![0x34, 0x12])?, Frame::new(info, vec![1, 0])?];
/// let FrameArrays::U16(pixels) = FrameArrays::of_frames(info, &frames).ok_or("of one size")? else {
///     return Err("16 bits".into());
/// };
/// assert_eq!((pixels.dim(), pixels[[0, 0, 0, 0]]), ((2, 1, 1, 1), 0x1234));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum FrameArrays {
    /// Pixels with 8 bits per value.
    U8(Array4<u8>),
    /// Pixels with 16 bits per value.
    U16(Array4<u16>),
}

/// 8-bit pixels are moved without a copy; 16-bit pixels are converted to the byte order of the machine.
impl From<Frame> for FrameArray {
    fn from(frame: Frame) -> FrameArray {
        let shape = shape(frame.info());
        // A frame has as many numbers as its shape, which its constructor checks.
        match frame.info().format.bytes_per_sample() {
            1 => FrameArray::U8(of_len(shape, frame.into_bytes())),
            _ => FrameArray::U16(of_len(shape, frame.samples().collect())),
        }
    }
}

impl FrameArrays {
    /// Copies `frames` of the format `info` into one array; `None` if a frame has another size or format.
    ///
    /// ```
    /// use taceva_core::{FrameInfo, PixelFormat};
    /// use taceva_dataset::FrameArrays;
    /// let info = FrameInfo { width: 4, height: 3, format: PixelFormat::Gray8 };
    /// assert!(matches!(FrameArrays::of_frames(info, &[]), Some(FrameArrays::U8(none)) if none.dim() == (0, 3, 4, 1)));
    /// ```
    pub fn of_frames<'a>(
        info: FrameInfo,
        frames: impl IntoIterator<Item = &'a Frame>,
    ) -> Option<FrameArrays> {
        let mut pixels = Pixels::new(info);
        let fit = frames.into_iter().all(|frame| pixels.push(frame));
        fit.then(|| pixels.finish())
    }
}

impl Dataset {
    /// Frame of a row as an array, verified and decoded; `None` if the row has no frame.
    ///
    /// # Errors
    /// Errors of [`frame`](Dataset::frame).
    ///
    /// ```
    /// use taceva_dataset::{Dataset, FrameArray};
    ///
    /// fn brightest(dataset: &Dataset) -> Result<Option<u16>, taceva_dataset::DatasetError> {
    ///     Ok(dataset.frame_array(0)?.and_then(|frame| match frame {
    ///         FrameArray::U8(pixels) => pixels.iter().copied().max().map(u16::from),
    ///         FrameArray::U16(pixels) => pixels.iter().copied().max(),
    ///         _ => None,
    ///     }))
    /// }
    /// # let _ = brightest;
    /// ```
    pub fn frame_array(&self, row: usize) -> Result<Option<FrameArray>, DatasetError> {
        Ok(self.frame(row)?.map(FrameArray::from))
    }

    /// Frames of the rows of `pass` as one array, in the order of `pass`, verified and decoded on several threads. All frames must fit into memory.
    ///
    /// # Errors
    /// Errors of [`map_frames`](Dataset::map_frames), also for the first row without a frame; [`DatasetError::Request`] if the dataset has no frames.
    ///
    /// ```
    /// use std::num::NonZeroUsize;
    /// use taceva_core::SilentProgress;
    /// use taceva_dataset::{Dataset, FrameArrays, Pass};
    ///
    /// fn first_eight(dataset: &Dataset) -> Result<FrameArrays, taceva_dataset::DatasetError> {
    ///     let rows: Vec<usize> = (0..8).collect();
    ///     dataset.frame_arrays(Pass::new(&rows, NonZeroUsize::MIN, &SilentProgress))
    /// }
    /// # let _ = first_eight;
    /// ```
    pub fn frame_arrays(&self, pass: Pass<'_>) -> Result<FrameArrays, DatasetError> {
        self.require_view()?;
        let Some(frames) = &self.header().frames else {
            return Err(DatasetError::request(
                self.path(),
                "the dataset has no frames to decode",
            ));
        };
        let mut pixels = Pixels::new(frames.info);
        self.map_frames(
            pass,
            |_, frame| frame,
            |_, frame| match pixels.push(&frame) {
                true => Ok(()),
                // Unreachable: the reader already compared size and format.
                false => Err(format!("a frame of {}", frame.info()).into()),
            },
        )?;
        Ok(pixels.finish())
    }
}

/// Height, width and number of channels.
fn shape(info: FrameInfo) -> [usize; 3] {
    // Cannot overflow: a frame of that size is in memory.
    let [height, width] = [info.height, info.width].map(|side| side as usize);
    [height, width, info.format.samples()]
}

/// Array of this shape with `values` in order; empty if their number does not match the shape.
fn of_len<T: Clone + Default>(shape: [usize; 3], values: Vec<T>) -> Array3<T> {
    Array3::from_shape_vec(shape, values).unwrap_or_default()
}

/// Pixel values of consecutive frames of the same size and format.
struct Pixels {
    info: FrameInfo,
    frames: usize,
    bytes: Vec<u8>,
    words: Vec<u16>,
}

impl Pixels {
    fn new(info: FrameInfo) -> Pixels {
        Pixels {
            info,
            frames: 0,
            bytes: Vec::new(),
            words: Vec::new(),
        }
    }

    /// Adds the pixels of `frame`; returns false if its size or format differs.
    fn push(&mut self, frame: &Frame) -> bool {
        if frame.info() != self.info {
            return false;
        }
        self.frames += 1;
        match self.info.format.bytes_per_sample() {
            1 => self.bytes.extend_from_slice(frame.bytes()),
            _ => self.words.extend(frame.samples()),
        }
        true
    }

    fn finish(self) -> FrameArrays {
        let [height, width, channels] = shape(self.info);
        let shape = [self.frames, height, width, channels];
        // The length fits the shape, because every added frame has this size.
        match self.info.format.bytes_per_sample() {
            1 => FrameArrays::U8(Array4::from_shape_vec(shape, self.bytes).unwrap_or_default()),
            _ => FrameArrays::U16(Array4::from_shape_vec(shape, self.words).unwrap_or_default()),
        }
    }
}
