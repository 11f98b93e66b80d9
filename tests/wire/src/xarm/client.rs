//! Connection to one client, for answers and for messages that the box sends without a request.

use std::io::Write;
use std::net::TcpStream;
use std::sync::{Arc, Mutex, PoisonError};

/// Connection for the answers to one client.
#[derive(Clone, Debug)]
pub(super) struct Client {
    stream: Arc<Mutex<TcpStream>>,
}

impl Client {
    /// Client at the other end of `stream`.
    pub(super) fn over(stream: TcpStream) -> Client {
        Client {
            stream: Arc::new(Mutex::new(stream)),
        }
    }

    /// Sends bytes, if the client is still connected.
    pub(super) fn send(&self, bytes: &[u8]) {
        let mut stream = self.stream.lock().unwrap_or_else(PoisonError::into_inner);
        let _ = stream.write_all(bytes);
    }
}

/// Message that the box sends to a client at the end of a motion, if the client requested it.
#[derive(Clone, Debug)]
pub(super) struct Push {
    pub(super) client: Client,
    /// Transaction and protocol of the command.
    pub(super) head: [u8; 4],
}

impl Push {
    pub(super) const SUCCEEDED: u8 = 0;
    pub(super) const DISCARDED: u8 = 2;

    pub(super) fn send(&self, code: u8) {
        const MOTION_ENDED: u8 = 2;
        const MOVE_LINE: u8 = 21;
        let [t1, t0, p1, p0] = self.head;
        self.client.send(&[
            t1,
            t0,
            p1,
            p0,
            0,
            7,
            0xff,
            0,
            MOTION_ENDED,
            MOVE_LINE,
            0,
            0,
            code,
        ]);
    }
}
