//! Conversion of frames from decoding to presentation order.

use std::collections::BTreeMap;
use std::ops::ControlFlow;

use crate::clip::Picture;
use crate::error::VideoError;
use crate::limits;
use crate::source::Source;

/// Buffer of decoded frames that wait for earlier frames.
pub(crate) struct Reorder<'a> {
    source: &'a Source,
    /// Indices of the frames to return, in order.
    wanted: std::slice::Iter<'a, u64>,
    held: BTreeMap<u64, Picture>,
    held_bytes: u64,
}

impl<'a> Reorder<'a> {
    pub(crate) fn new(source: &'a Source, wanted: &'a [u64]) -> Reorder<'a> {
        Reorder {
            source,
            wanted: wanted.iter(),
            held: BTreeMap::new(),
            held_bytes: 0,
        }
    }

    /// Returns the frame and the frames that waited for it, or keeps it until earlier frames arrive.
    ///
    /// # Errors
    /// [`VideoError::TooLarge`] if the buffer exceeds its limit.
    pub(crate) fn add(
        &mut self,
        frame: u64,
        picture: Picture,
        each: &mut dyn FnMut(u64, Picture) -> ControlFlow<()>,
    ) -> Result<ControlFlow<()>, VideoError> {
        self.held_bytes += picture.size() as u64;
        self.held.insert(frame, picture);
        while let Some(next) = self.wanted.as_slice().first() {
            let Some(picture) = self.held.remove(next) else {
                break;
            };
            self.held_bytes -= picture.size() as u64;
            self.wanted.next();
            if each(*next, picture).is_break() {
                return Ok(ControlFlow::Break(()));
            }
        }
        if self.held_bytes > limits::HELD_BYTES {
            return Err(VideoError::TooLarge {
                path: self.source.path().to_owned(),
                what: "bytes of decoded frames that wait for presentation",
                found: self.held_bytes,
                limit: limits::HELD_BYTES,
            });
        }
        Ok(ControlFlow::Continue(()))
    }
}
