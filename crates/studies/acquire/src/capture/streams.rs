//! Streams of frames and readings.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, TryRecvError};
use std::time::Duration;

use taceva_core::Interrupt;
use taceva_dataset::StreamFacts;

use super::camera::Taken;
use super::predictor::LivePredictor;
use super::track::Track;

/// Maximum wait for one frame.
const LOOK: Duration = Duration::from_millis(20);

/// Counts that the device threads share, and the flag that ends these threads.
#[derive(Debug, Default)]
pub(super) struct Counts {
    is_over: AtomicBool,
    is_numbered: AtomicBool,
    dropped: AtomicU64,
    damaged: AtomicU64,
}

impl Counts {
    pub(super) fn of(is_numbered: bool) -> Counts {
        Counts {
            is_numbered: AtomicBool::new(is_numbered),
            ..Counts::default()
        }
    }

    pub(super) fn is_over(&self) -> bool {
        self.is_over.load(Ordering::Acquire)
    }

    pub(super) fn end(&self) {
        self.is_over.store(true, Ordering::Release);
    }

    /// Counts a frame as dropped for each sequence number missing between `last` and `number`. Damaged frames are already counted.
    pub(super) fn missed(&self, last: u64, number: u64) {
        let between = number.saturating_sub(last).saturating_sub(1);
        self.is_numbered.store(true, Ordering::Release);
        self.dropped.fetch_add(between, Ordering::AcqRel);
    }

    pub(super) fn count_dropped(&self) {
        self.dropped.fetch_add(1, Ordering::AcqRel);
    }

    pub(super) fn count_damaged(&self) {
        self.damaged.fetch_add(1, Ordering::AcqRel);
    }

    fn facts(&self) -> StreamFacts {
        let count = |of: &AtomicU64| of.load(Ordering::Acquire);
        StreamFacts::new(self.is_numbered.load(Ordering::Acquire))
            .with_lost(count(&self.dropped), count(&self.damaged))
    }
}

/// Streams of frames and readings from the devices.
pub(super) struct Streams<'a> {
    pub(super) queue: Receiver<Taken>,
    /// Readings of the transducer, if there is a transducer.
    pub(super) track: Option<&'a Track>,
    pub(super) counts: &'a Counts,
}

impl Streams<'_> {
    /// Next frame, after a short wait; `Err` if the stream has ended.
    pub(super) fn next(&self) -> Result<Option<Taken>, Ended> {
        match self.queue.recv_timeout(LOOK) {
            Ok(taken) => Ok(Some(taken)),
            Err(RecvTimeoutError::Timeout) => Ok(None),
            Err(RecvTimeoutError::Disconnected) => Err(Ended),
        }
    }

    /// Next frame in the queue, without waiting.
    pub(super) fn next_at_once(&self) -> Result<Option<Taken>, Ended> {
        match self.queue.try_recv() {
            Ok(taken) => Ok(Some(taken)),
            Err(TryRecvError::Empty) => Ok(None),
            Err(TryRecvError::Disconnected) => Err(Ended),
        }
    }

    pub(super) fn end(&self) {
        self.counts.end();
    }

    pub(super) fn count_damaged(&self) {
        self.counts.count_damaged();
    }

    /// Current counts of lost frames.
    pub(super) fn facts(&self) -> StreamFacts {
        self.counts.facts()
    }
}

/// Error of a stream of frames that has ended.
#[derive(Debug)]
pub(super) struct Ended;

/// Guard that ends the device threads when it is dropped.
pub(super) struct Over<'a> {
    pub(super) counts: &'a Counts,
    pub(super) interrupt: Option<Arc<dyn Interrupt>>,
    pub(super) predictor: Option<&'a LivePredictor<'a>>,
}

impl Drop for Over<'_> {
    fn drop(&mut self) {
        self.counts.end();
        if let Some(interrupt) = &self.interrupt {
            interrupt.interrupt();
        }
        if let Some(predictor) = self.predictor {
            predictor.end();
        }
    }
}
