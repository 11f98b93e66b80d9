//! Frames of a recording. The journal names a frame only after the frame and the name of its pack are durable.

use taceva_core::{Frame, FrameError, Sample};
use taceva_files::parent_of;

use super::{Recorder, Streamed};
use crate::decode::{ChannelOrder, decode};
use crate::difference;
use crate::digest::Digest;
use crate::encode::PngFile;
use crate::error::DatasetError;
use crate::file::{make_names_durable, open_regular, write_durable};
use crate::header::FramesInfo;
use crate::layout;
use crate::pack::{PackWriter, cut_behind, read_span};
use crate::table::FrameEntry;

impl Recorder {
    /// Appends the frames of `samples` to the pack, and returns once all are durable. Returns one entry per sample.
    pub(super) fn write_frames(
        &mut self,
        samples: &[Sample],
    ) -> Result<Vec<Option<FrameEntry>>, DatasetError> {
        let frames = samples.iter().map(|sample| (sample.frame.as_ref(), None));
        self.write_each(frames.collect())
    }

    /// Appends frames like [`write_frames`](Recorder::write_frames), but stores files sent by a camera unchanged.
    pub(super) fn write_streamed(
        &mut self,
        stream: &[Streamed],
    ) -> Result<Vec<Option<FrameEntry>>, DatasetError> {
        let frames = stream
            .iter()
            .map(|streamed| (streamed.sample.frame.as_ref(), streamed.sent.as_deref()));
        self.write_each(frames.collect())
    }

    fn write_each(
        &mut self,
        frames: Vec<(Option<&Frame>, Option<&[u8]>)>,
    ) -> Result<Vec<Option<FrameEntry>>, DatasetError> {
        if frames.iter().all(|(frame, _)| frame.is_none()) {
            return Ok(vec![None; frames.len()]);
        }
        // After an error the pack is reopened, and unacknowledged bytes are cut.
        let mut pack = match self.pack.take() {
            Some(pack) => pack,
            None => {
                cut_behind(&self.path, self.pack_end)?;
                self.first = self.first_of_pack()?;
                PackWriter::open(&self.path, self.pack_end)?
            }
        };
        let mut entries = Vec::with_capacity(frames.len());
        for (frame, sent) in frames {
            let entry = frame.map(|frame| match sent {
                Some(sent) => self.append_sent(&mut pack, sent),
                None => self.append_frame(&mut pack, frame),
            });
            entries.push(entry.transpose()?);
        }
        pack.sync()?;
        self.pack = Some(pack);
        Ok(entries)
    }

    /// Appends a frame, or its difference to the first frame of the pack if the difference is smaller.
    fn append_frame(
        &mut self,
        pack: &mut PackWriter,
        frame: &Frame,
    ) -> Result<FrameEntry, DatasetError> {
        pack.roll()?;
        let whole = self.png(frame, layout::FRAMES)?;
        let is_first = pack.end().length == 0;
        let difference = match &self.first {
            // A frame equal to the first is stored whole: equal frames have equal digests.
            Some((digest, first)) if !is_first && frame != first => {
                let damaged = |error: FrameError| self.damaged(error.to_string());
                let difference = difference::less(frame, first).map_err(damaged)?;
                let planned = self.png(&difference, layout::FRAMES)?;
                // Only the shorter file is written.
                (planned.len() < whole.len()).then(|| {
                    let bytes = planned.write();
                    let digest = difference::digest(*digest, &bytes);
                    (bytes, digest)
                })
            }
            _ => None,
        };
        let is_difference = difference.is_some();
        let (bytes, digest) = difference.unwrap_or_else(|| {
            let bytes = whole.write();
            let digest = Digest::of(&bytes);
            (bytes, digest)
        });
        let (path, span) = pack.append(&bytes, is_difference)?;
        if is_first {
            self.first = Some((digest, frame.clone()));
        }
        Ok(FrameEntry {
            path,
            span: Some(span),
            digest,
        })
    }

    /// Appends a file sent by a camera.
    fn append_sent(
        &mut self,
        pack: &mut PackWriter,
        sent: &[u8],
    ) -> Result<FrameEntry, DatasetError> {
        pack.roll()?;
        if pack.end().length == 0 {
            // The next encoded frame of this pack is stored whole, because this one is not decoded for a difference.
            self.first = None;
        }
        let (path, span) = pack.append(sent, false)?;
        Ok(FrameEntry {
            path,
            span: Some(span),
            digest: Digest::of(sent),
        })
    }

    /// First frame of the current pack, and its digest.
    fn first_of_pack(&self) -> Result<Option<(Digest, Frame)>, DatasetError> {
        let path = layout::pack_path(self.pack_end.number);
        let mut frames = self.table.frames().iter().flatten();
        let Some((entry, span)) = frames
            .find(|entry| entry.begins(&path))
            .and_then(|entry| Some((entry, entry.span?)))
        else {
            return Ok(None);
        };
        let pack = self.path.join(&path);
        let (file, _) = open_regular(&pack, u64::MAX)?;
        let bytes = read_span(file, &pack, span)?;
        if Digest::of(&bytes) != entry.digest {
            return Err(self.damaged("its first frame differs from the recorded frame".to_owned()));
        }
        let info = self.frames_info();
        let order = info.map_or(ChannelOrder::Rgb, |info| info.channel_order);
        let (_, frame) = decode(&bytes, order).map_err(|problem| self.damaged(problem))?;
        Ok(Some((entry.digest, frame)))
    }

    fn damaged(&self, problem: String) -> DatasetError {
        DatasetError::damaged(
            &self.path.join(layout::pack_path(self.pack_end.number)),
            problem,
        )
    }

    /// Writes a frame as a separate file, whose bytes and name are durable on return.
    pub(super) fn write_image(
        &self,
        relative: &str,
        frame: &Frame,
    ) -> Result<Digest, DatasetError> {
        let path = self.path.join(relative);
        let bytes = self.png(frame, relative)?.write();
        write_durable(&path, &bytes)?;
        make_names_durable(parent_of(&path))?;
        Ok(Digest::of(&bytes))
    }

    fn png(&self, frame: &Frame, relative: &str) -> Result<PngFile, DatasetError> {
        PngFile::plan(frame)
            .map_err(|problem| DatasetError::image(&self.path.join(relative), problem))
    }

    /// Properties shared by all recorded frames.
    pub(super) fn frames_info(&self) -> Option<FramesInfo> {
        let info = self.frame_info?;
        let is_gray = info.format.samples() == 1;
        Some(FramesInfo {
            count: self.table.frames().iter().flatten().count() as u64,
            info,
            channel_order: if is_gray {
                ChannelOrder::Gray
            } else {
                ChannelOrder::Rgb
            },
            codec: None,
            other_codecs: Vec::new(),
            reduced: self.reduced.clone(),
            reference: self.reference.clone(),
        })
    }
}
