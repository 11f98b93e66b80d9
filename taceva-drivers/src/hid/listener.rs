//! Thread that reads the reports of a HID device.

use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;

use hidapi::HidDevice;
use taceva_core::ErrorKind;

use crate::link::mailbox::Ending;
use crate::link::{Mailbox, monotonic};

/// Handle of the thread that reads a device's reports. Dropping the handle ends the thread.
#[derive(Debug)]
pub(super) struct Listener {
    is_over: Arc<AtomicBool>,
    reader: Option<JoinHandle<()>>,
}

/// Interval at which the thread checks whether it must end, ms.
const LOOK_MS: i32 = 50;
/// Maximum length of a report, bytes. Reports of full-speed devices are shorter; scales and pedals do not use high speed.
const REPORT_MAX: usize = 1024;

impl Listener {
    /// Starts a thread that parses each report with `read` and posts the result to `posting`. Skips reports for which `read` returns `None`.
    pub(super) fn start<T: Clone + Send + 'static>(
        device: HidDevice,
        posting: &Arc<Mailbox<T>>,
        mut read: impl FnMut(&[u8]) -> Option<T> + Send + 'static,
    ) -> io::Result<Listener> {
        let is_over = Arc::new(AtomicBool::new(false));
        let (over, posting) = (Arc::clone(&is_over), Arc::clone(posting));
        let reader = std::thread::Builder::new()
            .name("hid reports".to_owned())
            .spawn(move || {
                let mut bytes = [0; REPORT_MAX];
                while !over.load(Ordering::Acquire) {
                    match device.read_timeout(&mut bytes, LOOK_MS) {
                        Ok(0) => {}
                        Ok(count) => {
                            let at = monotonic();
                            if let Some(report) = read(&bytes[..count]) {
                                posting.post_last(1, report, at);
                            }
                        }
                        Err(error) => {
                            posting.end(Ending {
                                kind: ErrorKind::Disconnected,
                                why: format!(
                                    "the device was unplugged, or cannot be read: {error}"
                                ),
                            });
                            return;
                        }
                    }
                }
                posting.end(Ending {
                    kind: ErrorKind::Disconnected,
                    why: "the device was closed".to_owned(),
                });
            })?;
        Ok(Listener {
            is_over,
            reader: Some(reader),
        })
    }
}

impl Drop for Listener {
    fn drop(&mut self) {
        self.is_over.store(true, Ordering::Release);
        if let Some(reader) = self.reader.take() {
            let _ = reader.join();
        }
    }
}
