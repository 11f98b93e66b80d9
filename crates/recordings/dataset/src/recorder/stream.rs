//! Frames of a stream. Several frames are recorded together, with a single sync of the disk.

use taceva_core::Sample;

use super::payload::WrittenStream;
use super::{Recorder, ReplayError};
use crate::decode::{check_to_the_end, kind_of_whole};
use crate::error::DatasetError;
use crate::header::StreamFacts;
use crate::journal::RecordKind;

/// Sample of a stream, with the image file if the camera sends files.
///
/// ```
/// use taceva_core::Sample;
/// use taceva_dataset::Streamed;
///
/// let decoded = Streamed::new(Sample::new("frame 1"));
/// assert_eq!(decoded.sent, None);
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Streamed {
    /// Sample with its frame.
    pub sample: Sample,
    /// PNG, JPEG or TIFF file of the frame, stored unchanged; `None` if the camera sends no files.
    pub sent: Option<Vec<u8>>,
}

impl Streamed {
    /// Sample whose frame, if any, is still to be encoded.
    pub fn new(sample: Sample) -> Streamed {
        Streamed { sample, sent: None }
    }

    /// The same sample with the file of its frame as the camera sent it.
    ///
    /// # Errors
    /// Error message if the file is neither PNG nor JPEG nor TIFF, truncated, or damaged inside.
    pub fn with_sent(self, sent: Vec<u8>) -> Result<Streamed, String> {
        let kind = kind_of_whole(&sent)?;
        check_to_the_end(&sent, kind)?;
        Ok(Streamed {
            sent: Some(sent),
            ..self
        })
    }
}

impl Recorder {
    /// Records frames of a stream, and the losses of the stream so far. Returns the number of their journal record once all frames are durable.
    ///
    /// # Errors
    /// Errors of [`append_press`](Recorder::append_press). Nothing is recorded after an error.
    pub fn append_stream(
        &mut self,
        stream: &[Streamed],
        facts: StreamFacts,
    ) -> Result<u64, DatasetError> {
        let samples = || stream.iter().map(|streamed| &streamed.sample);
        self.check_together(samples())?;
        let entries = self.write_streamed(stream)?;
        let of_stream = |samples| WrittenStream::new(facts, samples).to_toml();
        let sequence = self.append_all(RecordKind::Stream, samples(), entries, of_stream)?;
        self.stream = Some(facts);
        Ok(sequence)
    }

    pub(super) fn replay_stream(&mut self, written: WrittenStream) -> Result<(), ReplayError> {
        for sample in written.samples {
            self.replay_sample(sample)?;
        }
        self.stream = Some(written.stream);
        Ok(())
    }
}
