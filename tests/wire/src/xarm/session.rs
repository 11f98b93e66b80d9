//! A client on the port of commands.

use std::io::Write;
use std::net::TcpStream;
use std::sync::{Arc, Mutex, PoisonError};

use super::answer;
use super::controller::Controller;
use crate::fault::Device;
use crate::server::{End, read};

/// Where the answers of one client go.
#[derive(Clone, Debug)]
pub(super) struct Client {
    stream: Arc<Mutex<TcpStream>>,
}

impl Client {
    /// Sends, if the client is still there.
    pub(super) fn send(&self, bytes: &[u8]) {
        let mut stream = self.stream.lock().unwrap_or_else(PoisonError::into_inner);
        let _ = stream.write_all(bytes);
    }
}

/// What a client that asked for it is told at the end of a motion.
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

const HEADER: usize = 6;

/// Answers until the client goes.
pub(super) fn serve(mut stream: TcpStream, controller: &Controller, end: &End) {
    let Ok(writing) = stream.try_clone() else {
        return;
    };
    let client = Client {
        stream: Arc::new(Mutex::new(writing)),
    };
    let mut session = answer::Session::default();
    let mut waiting: Vec<u8> = Vec::new();
    let mut bytes = [0; 1024];
    loop {
        match read(&mut stream, &mut bytes, end) {
            None => continue,
            Some(0) => return,
            Some(count) => waiting.extend_from_slice(&bytes[..count]),
        }
        while let Some(&[t1, t0, p1, p0, l1, l0]) = waiting.first_chunk::<HEADER>() {
            let length = usize::from(u16::from_be_bytes([l1, l0]));
            if waiting.len() < HEADER + length {
                break;
            }
            let frame: Vec<u8> = waiting.drain(..HEADER + length).collect();
            // A heartbeat of a client has register 0 and no answer.
            let Some((&register, parameters)) = frame[HEADER..].split_first() else {
                continue;
            };
            if register == 0 {
                continue;
            }
            let head = [t1, t0, p1, p0];
            let answers = session.answer(controller, &client, head, register, parameters);
            let bench = &controller.bench;
            std::thread::sleep(bench.delay(Device::Robot));
            if bench.withholds(Device::Robot) {
                continue;
            }
            for parameters in answers {
                client.send(&parameters);
            }
        }
    }
}
