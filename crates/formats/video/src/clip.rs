//! What is known of a clip, and what its frames are given as.

/// What is known of a clip without decoding it.
///
/// # Units
/// Sizes are pixels, times are seconds from the beginning of the presentation.
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
    /// The format of the file, such as `AVI` or `MP4`.
    pub container: String,
    /// The codec, with its profile where that is known, such as `MJPEG` or `H.264 High`.
    pub codec: String,
    /// How pixels are stored, by the names of FFmpeg, such as `yuv420p`.
    pub pixel_format: String,
    /// Width of every frame, pixels.
    pub width: u32,
    /// Height of every frame, pixels.
    pub height: u32,
    /// How many frames are presented.
    pub frames: u64,
    /// When each is presented, s; `None` where the container has no times.
    pub times_s: Option<Vec<f64>>,
    /// Whether the codec loses detail; `None` for a codec that has modes of both kinds.
    pub lossy: Option<bool>,
    /// What decodes the frames, with its version where it says one; `None` where frames are the packets of the clip as they are.
    pub decoder: Option<String>,
}

/// What is wanted of frames that are decoded.
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
    /// The luma plane as it is stored, untouched.
    Luma,
    /// Red, green and blue of 8 bits, converted by the matrix and range that the stream names (else BT.601, limited range), with the nearest sample
    /// of chroma. Of a stream of more than 8 bits the upper 8 are converted.
    Rgb,
}

/// A frame.
///
/// # Shapes
/// Samples lie row by row: `[height, width]`, with three colours `[height, width, 3]`.
///
/// ```
/// use taceva_video::Picture;
/// let whole = |picture: &Picture| match picture {
///     Picture::Jpeg(bytes) => bytes.starts_with(&[0xff, 0xd8]),
///     Picture::Pixels { width, height, samples } => samples.len() % (width * height) as usize == 0,
///     Picture::Deep { width, height, samples, .. } => samples.len() == (width * height) as usize,
///     _ => false,
/// };
/// assert!(whole(&Picture::Pixels { width: 2, height: 1, samples: vec![7, 9] }));
/// ```
#[derive(Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum Picture {
    /// A JPEG file, whatever [`Colours`] were asked for: the bytes that lie in the clip. Where these have no Huffman tables, as Motion JPEG may,
    /// the standard ones stand in it before the scan: without them no other program reads it.
    Jpeg(Vec<u8>),
    /// Pixels of 8 bits a sample.
    Pixels {
        /// Columns.
        width: u32,
        /// Rows.
        height: u32,
        /// Row by row: one number a pixel of [`Colours::Luma`], red, green and blue of [`Colours::Rgb`].
        samples: Vec<u8>,
    },
    /// The luma plane of a clip of more than 8 bits a sample.
    Deep {
        /// Columns.
        width: u32,
        /// Rows.
        height: u32,
        /// How many bits of each number are used: 9 to 16.
        bits: u32,
        /// Row by row, as in the stream: from 0 to below 2 to the power of `bits`.
        samples: Vec<u16>,
    },
}

impl Picture {
    /// How many bytes it takes.
    pub(crate) fn size(&self) -> usize {
        match self {
            Picture::Jpeg(bytes) => bytes.len(),
            Picture::Pixels { samples, .. } => samples.len(),
            Picture::Deep { samples, .. } => samples.len() * 2,
        }
    }
}

impl std::fmt::Debug for Picture {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Picture::Jpeg(bytes) => write!(f, "Jpeg({} bytes)", bytes.len()),
            Picture::Pixels { width, height, .. } => write!(f, "Pixels({width}×{height})"),
            Picture::Deep {
                width,
                height,
                bits,
                ..
            } => write!(f, "Deep({width}×{height}, {bits} bits)"),
        }
    }
}
