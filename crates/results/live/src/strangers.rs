//! Connections that have not shown the token: a few, of which the oldest makes room for the newest.

use std::collections::VecDeque;
use std::io;
use std::net::{Shutdown, TcpStream};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Connections without a token at most.
const STRANGERS_MAX: usize = 32;

/// Connections that have not shown the token, the oldest first.
#[derive(Default)]
pub(crate) struct Strangers {
    inside: Mutex<Inside>,
}

#[derive(Default)]
struct Inside {
    waiting: VecDeque<(u64, TcpStream)>,
    entered: u64,
}

impl Strangers {
    /// Counts one more connection, and closes the oldest one where there are too many.
    ///
    /// # Errors
    /// [`io::Error`] if the process has no file left for the connection.
    pub(crate) fn enter(self: &Arc<Strangers>, stream: &TcpStream) -> io::Result<Stranger> {
        let other = stream.try_clone()?;
        let mut inside = self.inside();
        inside.entered += 1;
        let number = inside.entered;
        inside.waiting.push_back((number, other));
        if inside.waiting.len() > STRANGERS_MAX
            && let Some((_, oldest)) = inside.waiting.pop_front()
        {
            // Its thread reads the end of the connection, and ends. A client that is gone already is closed.
            let _ = oldest.shutdown(Shutdown::Both);
        }
        drop(inside);
        Ok(Stranger {
            strangers: Arc::clone(self),
            number,
        })
    }

    fn inside(&self) -> MutexGuard<'_, Inside> {
        self.inside.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// One of the connections without a token, until this is dropped.
pub(crate) struct Stranger {
    strangers: Arc<Strangers>,
    number: u64,
}

impl Drop for Stranger {
    fn drop(&mut self) {
        let mut inside = self.strangers.inside();
        inside.waiting.retain(|(number, _)| *number != self.number);
    }
}
