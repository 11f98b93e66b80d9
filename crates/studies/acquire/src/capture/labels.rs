//! Frames, each with the wrench at its time, as samples.

use std::collections::VecDeque;

use taceva_core::{Channel, Channels, Readings, Sample, Wrench};
use taceva_dataset::Streamed;
use taceva_drivers::MonotonicClock;

use super::camera::{ROOM, Taken};
use super::contacts::Contacts;
use super::streams::Streams;
use super::track::At;

/// Frames that may wait for the reading after them: then the oldest goes without one.
const WAITING_MAX: usize = 64;
/// How much longer than readings may be apart a frame waits for one, in s: what links and threads take.
const SLACK_S: f64 = 0.1;

/// Frames that wait for their force.
pub(super) struct Labels {
    channels: Channels,
    waiting: VecDeque<Taken>,
    /// Samples that were made.
    frames: u64,
    has_ended: bool,
}

/// A frame, and the wrench at its time, if that is known.
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
            has_ended: false,
        }
    }

    /// Samples that were made so far.
    pub(super) fn frames(&self) -> u64 {
        self.frames
    }

    /// Whether samples have no labels at all.
    pub(super) fn is_empty(&self) -> bool {
        self.channels.is_empty()
    }

    /// Takes what came; whether there is or will be more.
    pub(super) fn collect(&mut self, streams: &Streams<'_>) -> bool {
        if self.has_ended {
            return !self.waiting.is_empty();
        }
        let mut next = streams.next();
        for _ in 0..ROOM {
            match next {
                Ok(Some(taken)) => self.waiting.push_back(taken),
                Ok(None) => break,
                Err(_) => {
                    self.has_ended = true;
                    break;
                }
            }
            next = streams.next_at_once();
        }
        true
    }

    /// The oldest frame, once it is known what force there was.
    pub(super) fn next(&mut self, streams: &Streams<'_>) -> Option<Labelled> {
        let stamp_s = self.waiting.front()?.stamp.valid_s;
        let wrench = match streams.track.map(|track| (track, track.at(stamp_s))) {
            None | Some((_, At::Gap)) => None,
            Some((_, At::Known(wrench))) => Some(wrench),
            Some((track, At::Early)) => {
                let waited_s = MonotonicClock.now_s() - stamp_s;
                let is_late = waited_s > track.longest_s() + SLACK_S;
                if !is_late && !self.has_ended && self.waiting.len() <= WAITING_MAX {
                    return None;
                }
                None
            }
        };
        let taken = self.waiting.pop_front()?;
        Some(Labelled { taken, wrench })
    }

    /// The sample of a frame, and its time in s.
    ///
    /// # Errors
    /// What is wrong with the file that the camera sent.
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

    /// The normal force of a sample.
    pub(super) fn normal_n(&self, sample: &Sample) -> Option<f64> {
        let position = self.channels.position(Channel::FZ.name())?;
        sample.truth.get(position)
    }
}
