//! Labels frames with the wrench at the time of each frame.

use std::collections::VecDeque;

use taceva_core::{Channel, Channels, Readings, Sample, Wrench};
use taceva_dataset::Streamed;
use taceva_drivers::MonotonicClock;

use super::camera::{ROOM, Taken};
use super::contacts::Contacts;
use super::streams::Streams;
use super::track::At;

/// Maximum number of frames that wait for a later reading. If there are more, the oldest frame is recorded without a force.
const WAITING_MAX: usize = 64;
/// Additional wait for a reading after the longest allowed gap, in s. It allows for the latency of links and threads.
const SLACK_S: f64 = 0.1;

/// Frames that wait for their force.
pub(super) struct Labels {
    channels: Channels,
    waiting: VecDeque<Taken>,
    /// Number of samples created.
    frames: u64,
    lost: LostForces,
    has_ended: bool,
}

/// Numbers of frames without a force, by cause.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct LostForces {
    /// Number of frames before the first force reading.
    pub(super) before: u64,
    /// Number of frames between two force readings that are too far apart.
    pub(super) in_gaps: u64,
    /// Number of frames after which no force reading arrived in time.
    pub(super) late: u64,
}

/// A frame with the wrench at its time; the wrench is `None` if unknown.
pub(super) struct Labelled {
    taken: Taken,
    wrench: Option<Wrench>,
}

impl Labels {
    pub(super) fn new(channels: Channels) -> Labels {
        Labels {
            channels,
            waiting: VecDeque::new(),
            frames: 0,
            lost: LostForces::default(),
            has_ended: false,
        }
    }

    /// Number of created samples.
    pub(super) fn frames(&self) -> u64 {
        self.frames
    }

    /// Number of frames without a force, by cause.
    pub(super) fn lost(&self) -> LostForces {
        self.lost
    }

    /// True if the samples have no label channels.
    pub(super) fn is_empty(&self) -> bool {
        self.channels.is_empty()
    }

    /// Receives frames. Returns false if the stream has ended and no frame waits.
    pub(super) fn collect(&mut self, streams: &Streams<'_>) -> bool {
        if self.has_ended {
            return !self.waiting.is_empty();
        }
        for place in 0..ROOM {
            let next = match place {
                0 => streams.next(),
                _ => streams.next_at_once(),
            };
            match next {
                Ok(Some(taken)) => self.waiting.push_back(taken),
                Ok(None) => break,
                Err(_) => {
                    self.has_ended = true;
                    break;
                }
            }
        }
        true
    }

    /// Returns the oldest frame if its force is known, or can no longer become known.
    pub(super) fn next(&mut self, streams: &Streams<'_>) -> Option<Labelled> {
        let stamp_s = self.waiting.front()?.stamp.valid_s;
        let wrench = match streams.track.map(|track| (track, track.at(stamp_s))) {
            None => None,
            Some((_, At::Known(wrench))) => Some(wrench),
            Some((_, At::Gap)) => {
                self.lost.in_gaps += 1;
                None
            }
            Some((_, At::Before)) => {
                self.lost.before += 1;
                None
            }
            Some((track, At::Early)) => {
                let waited_s = MonotonicClock.now_s() - stamp_s;
                let is_late = waited_s > track.longest_s() + SLACK_S;
                if !is_late && !self.has_ended && self.waiting.len() <= WAITING_MAX {
                    return None;
                }
                self.lost.late += 1;
                None
            }
        };
        let taken = self.waiting.pop_front()?;
        Some(Labelled { taken, wrench })
    }

    /// Creates the sample of a frame. Also returns its time, in s.
    ///
    /// # Errors
    /// The error in the encoded file from the camera.
    pub(super) fn sample(
        &mut self,
        Labelled { taken, wrench }: Labelled,
        contacts: &mut Option<Contacts>,
    ) -> Result<(Streamed, f64), String> {
        let truth = Readings::of_contact(&self.channels, None, wrench.as_ref());
        let mut sample = Sample::new(format!("frame-{:06}", self.frames + 1))
            .with_stamp(taken.stamp)
            .with_truth(truth)
            .with_frame(taken.frame);
        let mut streamed = Streamed::new(Sample::new(""));
        if let Some(sent) = taken.sent {
            streamed = streamed.with_sent(sent)?;
        }
        if let Some(contacts) = contacts {
            sample = sample.with_point_id(contacts.name(wrench.map(|wrench| wrench.force[2].0)));
        }
        self.frames += 1;
        streamed.sample = sample;
        Ok((streamed, taken.stamp.valid_s))
    }

    /// Normal force of a sample, in N; `None` if it is unknown or not measured.
    pub(super) fn normal_n(&self, sample: &Sample) -> Option<f64> {
        let position = self.channels.position(Channel::FZ.name())?;
        sample.truth.get(position)
    }
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc::sync_channel;

    use taceva_core::{Frame, FrameInfo, PixelFormat, Stamp};

    use super::super::streams::Counts;
    use super::super::track::Track;
    use super::*;

    fn taken(valid_s: f64) -> Taken {
        let info = FrameInfo {
            width: 1,
            height: 1,
            format: PixelFormat::Gray8,
        };
        let stamp = Stamp {
            valid_s,
            received_s: None,
        };
        Taken {
            frame: Frame::new(info, vec![0]).expect("a byte"),
            stamp,
            sent: None,
        }
    }

    #[test]
    fn every_frame_without_a_force_is_counted_by_cause() {
        let track = Track::new(0.01, None);
        for at_s in [1.0, 1.01, 1.2, 1.21] {
            track.push(at_s, Wrench::default());
        }
        // One more than are received at once.
        let times_s = [0.5, 0.9, 1.005, 1.1, 1.15, 1.18, 1.205, 1.3, 1.4];
        assert_eq!(times_s.len(), ROOM + 1);
        let (sender, queue) = sync_channel(times_s.len());
        for valid_s in times_s {
            sender.send(taken(valid_s)).expect("there is room");
        }
        drop(sender);
        let counts = Counts::of(true);
        let streams = Streams {
            queue,
            track: Some(&track),
            counts: &counts,
        };
        let mut labels = Labels::new(Channels::new([Channel::FZ]).expect("one"));
        let mut known = 0;
        while labels.collect(&streams) {
            while let Some(labelled) = labels.next(&streams) {
                known += u32::from(labelled.wrench.is_some());
            }
        }
        assert_eq!(known, 2);
        let expected = LostForces {
            before: 2,
            in_gaps: 3,
            late: 2,
        };
        assert_eq!(labels.lost(), expected);
    }
}
