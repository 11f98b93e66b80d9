//! Limits the number of connections without the token. A connection beyond the limit closes the oldest.

use std::collections::VecDeque;
use std::io;
use std::net::{Shutdown, TcpStream};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Maximum number of connections without the token.
const STRANGERS_MAX: usize = 32;

/// Connections without the token, the oldest first.
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
    /// Adds a connection, and closes the oldest connection if there are too many.
    ///
    /// # Errors
    /// [`io::Error`] if the process has no file descriptor left for the connection.
    pub(crate) fn enter(self: &Arc<Strangers>, stream: &TcpStream) -> io::Result<Stranger> {
        let other = stream.try_clone()?;
        let mut inside = self.inside();
        inside.entered += 1;
        let number = inside.entered;
        inside.waiting.push_back((number, other));
        if inside.waiting.len() > STRANGERS_MAX
            && let Some((_, oldest)) = inside.waiting.pop_front()
        {
            // The connection's thread then reads the end of the connection, and ends. An error means that the client has already gone.
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

/// Connection without the token, counted until drop.
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
