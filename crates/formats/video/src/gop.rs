//! Visits of frames that depend on other frames. Decoding begins at the key frame before each requested frame. Frames are returned in presentation order.

use std::ops::ControlFlow;

use crate::clip::Picture;
use crate::error::VideoError;
use crate::presentation_order::Reorder;
use crate::source::Source;

/// Decoder of the samples of a clip, in file order.
pub(crate) trait SampleDecoder {
    /// Error type of the decoder.
    type Refusal: From<VideoError>;

    /// True if decoding can begin at this sample.
    fn is_key(&self, sample: usize) -> Result<bool, VideoError>;

    /// Resets the decoder before the next sample.
    fn restart(&mut self);

    /// Decodes a sample that precedes or equals `towards`. Returns the picture if it is the wanted sample.
    fn decode(&mut self, sample: usize, towards: Wanted) -> Result<Option<Picture>, Self::Refusal>;
}

/// Requested frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Wanted {
    /// Index of the sample in decoding order.
    pub(crate) sample: usize,
    /// Index of the frame in presentation order.
    pub(crate) frame: u64,
}

/// Calls `each` with the frames whose indices are in `sorted`. `presented` contains sample indices in presentation order.
pub(crate) fn visit<D: SampleDecoder>(
    decoder: &mut D,
    source: &Source,
    presented: &[u32],
    sorted: &[u64],
    each: &mut dyn FnMut(u64, Picture) -> ControlFlow<()>,
) -> Result<(), D::Refusal> {
    let mut wanted = Vec::with_capacity(sorted.len());
    for &frame in sorted {
        let sample = usize::try_from(frame)
            .ok()
            .and_then(|place| presented.get(place));
        let Some(&sample) = sample else {
            return Err(VideoError::NoFrame {
                path: source.path().to_owned(),
                index: frame,
                frames: presented.len() as u64,
            }
            .into());
        };
        let sample = sample as usize;
        wanted.push(Wanted { sample, frame });
    }
    wanted.sort_unstable();
    let mut reorder = Reorder::new(source, sorted);
    let mut next = 0;
    for wanted in wanted {
        // Without a key frame in between, decoding continues.
        for key in (next..=wanted.sample).rev() {
            if decoder.is_key(key)? {
                next = key;
                decoder.restart();
                break;
            }
        }
        while next <= wanted.sample {
            let picture = decoder.decode(next, wanted)?;
            next += 1;
            if let Some(picture) = picture
                && reorder.add(wanted.frame, picture, each)?.is_break()
            {
                return Ok(());
            }
        }
    }
    Ok(())
}
