//! Serves one client of an emulated SRI box.

use std::io::{self, Write};
use std::net::TcpStream;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use crate::base::Base;
use crate::bench::WallBench;
use crate::fault::{Device, FaultKind};
use crate::link::Link;
use crate::server::{End, read};

/// Settings of one client.
#[derive(Debug)]
struct Settings {
    rate_hz: u32,
    is_streaming: bool,
    is_crc32: bool,
}

/// Stream of one client, with its settings.
#[derive(Debug)]
struct Session {
    settings: Mutex<Settings>,
    stream: Mutex<TcpStream>,
}

impl Session {
    fn settings(&self) -> MutexGuard<'_, Settings> {
        self.settings.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn send(&self, bytes: &[u8]) -> io::Result<()> {
        let mut stream = self.stream.lock().unwrap_or_else(PoisonError::into_inner);
        stream.write_all(bytes)
    }
}

/// Supported rates of readings, Hz.
const RATES_HZ: std::ops::RangeInclusive<u32> = 1..=2_000;
/// Duration of zeroing.
const ZEROING: Duration = Duration::from_millis(100);

/// Answers commands until the client closes; readings have a separate thread.
pub(super) fn serve(mut stream: TcpStream, bench: &WallBench, end: &End) {
    let Ok(writing) = stream.try_clone() else {
        return;
    };
    let session = Arc::new(Session {
        settings: Mutex::new(Settings {
            rate_hz: 200,
            is_streaming: false,
            is_crc32: false,
        }),
        stream: Mutex::new(writing),
    });
    let over = End::default();
    let sending = (Arc::clone(&session), bench.clone(), over.clone());
    let sender = std::thread::spawn(move || stream_readings(&sending.0, &sending.1, &sending.2));
    let mut waiting = String::new();
    let mut bytes = [0; 1024];
    loop {
        match read(&mut stream, &mut bytes, end) {
            None => continue,
            Some(0) => break,
            Some(count) => waiting.push_str(&String::from_utf8_lossy(&bytes[..count])),
        }
        while let Some((line, rest)) = waiting.split_once("\r\n") {
            let answer = line
                .strip_prefix("AT+")
                .and_then(|command| answer(command, &session, bench));
            waiting = rest.to_owned();
            if let Some(answer) = answer {
                // A closed client ends its connection.
                let _ = session.send(format!("ACK+{answer}\r\n").as_bytes());
            }
        }
    }
    over.come();
    let _ = sender.join();
}

/// Decoupling matrix of the box.
const MATRIX: &str =
    "(1,0,0,0,0,0);(0,1,0,0,0,0);(0,0,1,0,0,0);(0,0,0,1,0,0);(0,0,0,0,1,0);(0,0,0,0,0,1)";

/// Answer to a command; `None` for a command without an answer.
fn answer(command: &str, session: &Session, bench: &WallBench) -> Option<String> {
    let (word, value) = command.split_once('=').unwrap_or((command, ""));
    let accepted = match word {
        "SMPF" => match value.parse() {
            Ok(rate) if RATES_HZ.contains(&rate) => {
                session.settings().rate_hz = rate;
                true
            }
            _ => false,
        },
        "DCKMD" => match value {
            "SUM" | "CRC32" => {
                session.settings().is_crc32 = value == "CRC32";
                true
            }
            _ => false,
        },
        "SGDM" => value == "(A01,A02,A03,A04,A05,A06);E;1;(WMA:1)",
        "DCPM" if value == "?" => return Some(format!("DCPM={MATRIX}$OK")),
        "DCPCU" if value == "?" => return Some("DCPCU=MVPV$OK".to_owned()),
        "GSD" if value == "STOP" => {
            session.settings().is_streaming = false;
            true
        }
        "GSD" => {
            session.settings().is_streaming = true;
            return None;
        }
        "ADJZF" if session.settings().is_streaming => return None,
        "ADJZF" => {
            bench.tare();
            std::thread::sleep(ZEROING);
            value == "1;1;1;1;1;1"
        }
        _ => false,
    };
    let outcome = if accepted { "OK" } else { "ERROR" };
    Some(format!("{command}${outcome}"))
}

/// Start of a frame that claims 65535 bytes. The mark of another frame is in its middle.
const HOSTILE: &[u8] = &[0xaa, 0x55, 0xff, 0xff, 0xaa, 0x55, 0x00];
/// Increment of the frame number under the fault that skips numbers.
const SKIPPED: u16 = 7;

/// Sends readings at regular times while the client wants them.
fn stream_readings(session: &Session, bench: &WallBench, over: &End) {
    /// Interval at which the thread checks if the client wants readings.
    const LOOK: Duration = Duration::from_millis(2);
    let mut number: u16 = 0;
    let mut due = bench.now();
    let mut shown = [0.0; 3];
    let mut link = Link::new(Device::Force, HOSTILE);
    while !over.has_come() {
        let Settings {
            rate_hz,
            is_streaming,
            is_crc32,
        } = *session.settings();
        let now = bench.now();
        if !is_streaming {
            due = now;
            link.forget();
            std::thread::sleep(LOOK);
            continue;
        }
        if due > now {
            if link
                .rest_until(bench, due, |bytes| session.send(bytes))
                .is_err()
            {
                return;
            }
            continue;
        }
        due += Duration::from_secs(1) / rate_hz;
        number = number.wrapping_add(match bench.is_faulty(Device::Force, FaultKind::Gap) {
            true => SKIPPED,
            false => 1,
        });
        if !bench.is_faulty(Device::Force, FaultKind::Frozen) {
            shown = Base::turn(bench.reading_n());
        }
        let mut values = [shown[0], shown[1], shown[2], 0.0, 0.0, 0.0];
        if bench.is_faulty(Device::Force, FaultKind::NotANumber) {
            values[2] = f64::NAN;
        }
        if bench.is_faulty(Device::Force, FaultKind::Saturated) {
            values[2] = -bench.force_range_n();
        }
        let frame = frame(number, values, is_crc32);
        if link
            .send(bench, &frame, |bytes| session.send(bytes))
            .is_err()
        {
            return;
        }
    }
}

/// A frame with six numbers, and a checksum by sum or by CRC32.
fn frame(number: u16, values: [f64; 6], is_crc32: bool) -> Vec<u8> {
    #[expect(
        clippy::cast_possible_truncation,
        reason = "the frame has no finer numbers; a cast rounds to the nearest"
    )]
    let single = |value: f64| value as f32;
    let data: Vec<u8> = values
        .into_iter()
        .flat_map(|value| single(value).to_le_bytes())
        .collect();
    let sum = data.iter().fold(0_u8, |sum, byte| sum.wrapping_add(*byte));
    let check = match is_crc32 {
        true => crc32fast::hash(&data).to_le_bytes().to_vec(),
        false => vec![sum],
    };
    let length: u16 = if is_crc32 { 30 } else { 27 };
    let mut frame = vec![0xaa, 0x55];
    frame.extend(length.to_be_bytes());
    frame.extend(number.to_be_bytes());
    frame.extend(data);
    frame.extend(check);
    frame
}
