//! Frames that build on each other: decoded from the key frame before what is wanted, shown in the order of presentation.

use std::ops::ControlFlow;

use crate::clip::Picture;
use crate::error::VideoError;
use crate::presentation_order::Reorder;
use crate::source::Source;

/// What decodes samples one after the other, in the order in which they lie.
pub(crate) trait SampleDecoder {
    /// Why it does not.
    type Refusal: From<VideoError>;

    /// Whether decoding can begin at the sample of this number.
    fn is_key(&self, sample: usize) -> Result<bool, VideoError>;

    /// Forgets all samples before the next one.
    fn restart(&mut self);

    /// Decodes a sample on the way to the one that `towards` names; gives its picture if it is that one itself.
    fn decode(&mut self, sample: usize, towards: Wanted) -> Result<Option<Picture>, Self::Refusal>;
}

/// A frame that is wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Wanted {
    /// Its place in the order of decoding.
    pub(crate) sample: usize,
    /// Its place in the order of presentation.
    pub(crate) frame: u64,
}

/// Shows the frames of `sorted`; `presented` are the numbers of samples in the order of presentation.
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
        // Where it has to go on as it is, there is no key frame on the way.
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
