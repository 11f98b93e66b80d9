//! Serves one client on the command port.

use std::net::TcpStream;

use super::answer;
use super::client::Client;
use super::controller::Controller;
use crate::fault::Device;
use crate::server::{End, read};

const HEADER: usize = 6;

/// Answers the commands of a client until it closes.
pub(super) fn serve(mut stream: TcpStream, controller: &Controller, end: &End) {
    let Ok(writing) = stream.try_clone() else {
        return;
    };
    let client = Client::over(writing);
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
