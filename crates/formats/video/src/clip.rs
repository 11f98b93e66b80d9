//! Properties of a clip, and pictures of its frames.

/// Properties of a clip, known before its frames are decoded.
///
/// # Units
/// Sizes are in pixels, times in seconds from the beginning of the presentation.
///
/// ```
/// use taceva_video::{Decoders, Video};
/// # let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../tests/recordings/avi-mjpeg/cube_1.avi");
/// let clip = Video::open(file.as_ref(), &Decoders::default())?;
/// let info = clip.info();
/// assert_eq!((info.width, info.height, info.frames), (64, 48, 8));
/// assert_eq!((info.lossy, info.decoder.as_deref()), (Some(true), None));
/// # Ok::<(), taceva_video::VideoError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct VideoInfo {
    /// Format of the file, such as `AVI` or `MP4`.
    pub container: String,
    /// Codec, with its profile if known, such as `MJPEG` or `H.264 High`.
    pub codec: String,
    /// Pixel format as FFmpeg names it, such as `yuv420p`.
    pub pixel_format: String,
    /// Width of every frame, pixels.
    pub width: u32,
    /// Height of every frame, pixels.
    pub height: u32,
    /// Number of presented frames.
    pub frames: u64,
    /// Time of each frame, s; `None` if the container has no times.
    pub times_s: Option<Vec<f64>>,
    /// True for a lossy codec; `None` for a codec with lossy and lossless modes.
    pub lossy: Option<bool>,
    /// Decoder of the frames, with its version if known; `None` if the packets of the clip are returned undecoded.
    pub decoder: Option<String>,
}

/// Colours of decoded frames.
///
/// ```
/// use taceva_video::{Colours, Decoders, Picture, Video};
/// # let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../tests/recordings/mp4-h264-baseline/clip.mp4");
/// let clip = Video::open(file.as_ref(), &Decoders::default())?;
/// for (colours, numbers) in [(Colours::Luma, 1), (Colours::Rgb, 3)] {
///     clip.visit(&[0], colours, &mut |_, picture| match picture {
///         Picture::Pixels { samples, .. } if samples.len() == 64 * 48 * numbers => Ok(()),
///         other => Err(format!("{other:?}")),
///     })?;
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Colours {
    /// Luma plane as stored.
    Luma,
    /// Red, green and blue of 8 bits each, converted with the matrix and range of the stream. Each pixel takes the nearest chroma sample.
    /// The default is BT.601 in the limited range. Samples of more than 8 bits are reduced to their upper 8 bits.
    Rgb,
}

/// Picture of one frame of a clip.
///
/// # Shapes
/// Samples are row by row, in the shape `[height, width]`, or `[height, width, 3]` for three colours.
///
/// ```
/// use taceva_video::Picture;
/// let whole = |picture: &Picture| match picture {
///     Picture::Jpeg(bytes) => bytes.starts_with(&[0xff, 0xd8]),
///     Picture::Pixels { width, height, samples } => samples.len() % (width * height) as usize == 0,
///     Picture::Deep { width, height, samples, .. } => samples.len() == (width * height) as usize,
///     _ => false,
/// };
/// let picture = Picture::Pixels { width: 2, height: 1, samples: vec![7, 9] };
/// assert!(whole(&picture));
/// assert_eq!(picture.to_string(), "a picture of 2×1 pixels of 8 bits");
/// ```
#[derive(Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum Picture {
    /// JPEG file with the bytes in the clip, for any requested [`Colours`]. Some Motion JPEG has no Huffman tables. The standard tables are then inserted
    /// before the scan, so that other programs can read the file.
    Jpeg(Vec<u8>),
    /// Pixels of 8 bits per sample.
    Pixels {
        /// Width, pixels.
        width: u32,
        /// Height, pixels.
        height: u32,
        /// Samples row by row: one for each pixel with [`Colours::Luma`], or red, green and blue with [`Colours::Rgb`].
        samples: Vec<u8>,
    },
    /// Luma plane of a clip of more than 8 bits per sample.
    Deep {
        /// Width, pixels.
        width: u32,
        /// Height, pixels.
        height: u32,
        /// Bits of each sample: 9 to 16.
        bits: u32,
        /// Samples row by row, as in the stream: less than 2 to the power of `bits`.
        samples: Vec<u16>,
    },
}

impl Picture {
    /// Size in memory, bytes.
    pub(crate) fn size(&self) -> usize {
        match self {
            Picture::Jpeg(bytes) => bytes.len(),
            Picture::Pixels { samples, .. } => samples.len(),
            Picture::Deep { samples, .. } => samples.len() * 2,
        }
    }
}

impl std::fmt::Display for Picture {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Picture::Jpeg(bytes) => write!(f, "a JPEG file of {} bytes", bytes.len()),
            Picture::Pixels { width, height, .. } => {
                write!(f, "a picture of {width}×{height} pixels of 8 bits")
            }
            Picture::Deep {
                width,
                height,
                bits,
                ..
            } => write!(f, "a picture of {width}×{height} pixels of {bits} bits"),
        }
    }
}

impl std::fmt::Debug for Picture {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        std::fmt::Display::fmt(self, f)
    }
}
