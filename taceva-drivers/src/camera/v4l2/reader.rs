//! Thread that reads the images of a local camera and posts them to a mailbox.

use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;
use std::time::Duration;

use super::kernel::{Camera, Stream};

use super::error::kind_of;
use crate::link::mailbox::Ending;
use crate::link::{Mailbox, monotonic};

/// Image as the camera sent it, with its time stamp.
#[derive(Clone, Debug)]
pub(super) struct Picture {
    pub(super) bytes: Arc<[u8]>,
    /// Kernel time stamp on the monotonic clock; `None` if the kernel uses another clock or the stamp is later than the arrival.
    pub(super) taken: Option<Duration>,
    /// Number of images marked as damaged since the stream was started.
    pub(super) damaged: u64,
}

/// Thread that reads images until it is stopped, this value is dropped or the camera is gone.
#[derive(Debug)]
pub(super) struct Reader {
    is_over: Arc<AtomicBool>,
    thread: Option<JoinHandle<Camera>>,
}

/// Interval at which the thread checks the flag that ends it.
const LOOK: Duration = Duration::from_millis(50);

impl Reader {
    /// Starts a thread that posts every undamaged image of `stream` to `posting`, with the number of missed images.
    pub(super) fn start(stream: Stream, posting: &Arc<Mailbox<Picture>>) -> io::Result<Reader> {
        let is_over = Arc::new(AtomicBool::new(false));
        let (over, posting) = (Arc::clone(&is_over), Arc::clone(posting));
        let thread = std::thread::Builder::new()
            .name("v4l2 pictures".to_owned())
            .spawn(move || read(stream, &over, &posting))?;
        Ok(Reader {
            is_over,
            thread: Some(thread),
        })
    }

    /// Ends the thread and returns the camera; `None` if the thread panicked.
    pub(super) fn stop(mut self) -> Option<Camera> {
        self.is_over.store(true, Ordering::Release);
        self.thread.take()?.join().ok()
    }
}

impl Drop for Reader {
    fn drop(&mut self) {
        self.is_over.store(true, Ordering::Release);
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

fn read(mut stream: Stream, is_over: &AtomicBool, posting: &Mailbox<Picture>) -> Camera {
    let mut last: Option<u32> = None;
    let (mut damaged, mut missing) = (0, 0);
    while !is_over.load(Ordering::Acquire) {
        match stream.next(LOOK) {
            Ok(None) => {}
            Ok(Some(filled)) => {
                let at = monotonic();
                let number = filled.number();
                let step = last.map_or(1, |last| number.wrapping_sub(last));
                missing += u64::from(step.saturating_sub(1));
                last = Some(number);
                if filled.is_damaged() {
                    damaged += 1;
                    continue;
                }
                let picture = Picture {
                    bytes: filled.bytes().into(),
                    taken: filled.taken_at().filter(|taken| *taken <= at),
                    damaged,
                };
                posting.post_last(std::mem::take(&mut missing) + 1, picture, at);
            }
            Err(error) => {
                posting.end(Ending {
                    kind: kind_of(&error),
                    why: error.to_string(),
                });
                break;
            }
        }
    }
    stream.stop()
}
