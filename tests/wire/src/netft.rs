//! Emulated Net F/T box of ATI: records over UDP, and the page with its settings.
//!
//! The box supports start with a count of records, stop, bias, a tool frame and low pass filters. It serves one client at a time: the last one.
//! Buffered transfers, other pages and the TCP command port are not supported.

mod setup;

use std::io::{self, Read as _, Write as _};
use std::net::{Ipv4Addr, SocketAddr, TcpStream, UdpSocket};
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::Duration;

pub use self::setup::Setup;
use self::setup::{COUNTS, INTERNAL_HZ, RATE_HZ};
use crate::base::Base;
use crate::bench::WallBench;
use crate::error::WireError;
use crate::fault::{Device, FaultKind};
use crate::server::{End, Server};

/// Emulated Net F/T box that listens until drop.
#[derive(Debug)]
pub struct Emulator {
    records: SocketAddr,
    pages: Server,
    records_thread: Option<std::thread::JoinHandle<()>>,
    status: Arc<AtomicU32>,
    end: End,
}

/// The port of records that clients expect.
pub const USUAL_PORT: u16 = 49_152;

impl Emulator {
    /// Starts a box whose transducer measures the force on the gel of `bench`; port 0 selects any free port.
    ///
    /// # Errors
    /// [`WireError`] if the server cannot listen on a port.
    pub fn start(
        bench: &WallBench,
        host: Ipv4Addr,
        port: u16,
        page_port: u16,
    ) -> Result<Emulator, WireError> {
        Emulator::set_up(bench, host, port, page_port, Setup::PLAIN)
    }

    /// Starts a box with the settings `setup`.
    ///
    /// # Errors
    /// As [`start`](Emulator::start).
    pub fn set_up(
        bench: &WallBench,
        host: Ipv4Addr,
        port: u16,
        page_port: u16,
        setup: Setup,
    ) -> Result<Emulator, WireError> {
        let end = End::default();
        let page = setup.page(&bench.serial(), bench.force_range_n());
        let pages = Server::start(host, page_port, &end, move |stream| {
            // A closed client gets no answer.
            let _ = serve_page(stream, &page);
        })?;
        let refused = |source| WireError::Listen {
            address: format!("{host}:{port}"),
            source,
        };
        let socket = UdpSocket::bind((host, port)).map_err(refused)?;
        socket.set_nonblocking(true).map_err(refused)?;
        let records = socket.local_addr().map_err(refused)?;
        let status = Arc::new(AtomicU32::new(0));
        let sender = Sender {
            bench: bench.clone(),
            end: end.clone(),
            setup,
            status: Arc::clone(&status),
        };
        let thread = std::thread::Builder::new()
            .name("netft".to_owned())
            .spawn(move || sender.stream_records(&socket))
            .map_err(WireError::Thread)?;
        Ok(Emulator {
            records,
            pages,
            records_thread: Some(thread),
            status,
            end,
        })
    }

    /// Selector of the driver for this box, with its arguments.
    pub fn selector(&self) -> String {
        let [records, page] = [self.address(), self.page_address()];
        format!(
            "ati/netft:host={};port={};page_port={}",
            records.ip(),
            records.port(),
            page.port()
        )
    }

    /// Sets the status word of all later records: 0 for none, 0x80010000 for a latched threshold.
    pub fn set_status(&self, status: u32) {
        self.status.store(status, Ordering::Release);
    }

    /// Address of the record port.
    pub fn address(&self) -> SocketAddr {
        self.records
    }

    /// Address of the page with the settings.
    pub fn page_address(&self) -> SocketAddr {
        self.pages.address()
    }
}

impl Drop for Emulator {
    fn drop(&mut self) {
        self.end.come();
        if let Some(thread) = self.records_thread.take() {
            let _ = thread.join();
        }
    }
}

fn serve_page(mut stream: TcpStream, page: &str) -> io::Result<()> {
    let mut request = [0; 1024];
    let count = stream.read(&mut request)?;
    let answer = if request[..count].starts_with(b"GET /netftapi2.xml ") {
        let length = page.len();
        format!(
            "HTTP/1.0 200 OK\r\nContent-Type: text/xml\r\nContent-Length: {length}\r\n\r\n{page}"
        )
    } else {
        "HTTP/1.0 404 Not Found\r\nContent-Length: 0\r\n\r\n".to_owned()
    };
    stream.write_all(answer.as_bytes())
}

/// Client of the records, and the number of records that it still gets; `None` if it asked for records without end.
struct Client {
    to: SocketAddr,
    left: Option<u32>,
}

/// Sender of records.
struct Sender {
    bench: WallBench,
    end: End,
    setup: Setup,
    status: Arc<AtomicU32>,
}

impl Sender {
    /// Answers requests with records at regular times.
    fn stream_records(&self, socket: &UdpSocket) {
        /// Interval at which requests are read while no client wants records.
        const LOOK: Duration = Duration::from_millis(1);
        let bench = &self.bench;
        let mut client: Option<Client> = None;
        let mut number: u32 = 0;
        let mut due = bench.now();
        let mut shown = [0.0; 6];
        let range_n = bench.force_range_n();
        let mut request = [0; 64];
        while !self.end.has_come() {
            if let Ok((8, from)) = socket.recv_from(&mut request)
                && request.starts_with(&[0x12, 0x34, 0x00])
            {
                match request[3] {
                    0 => client = None,
                    2 | 3 => {
                        let [.., c0, c1, c2, c3] = request[..8] else {
                            continue;
                        };
                        let count = u32::from_be_bytes([c0, c1, c2, c3]);
                        let left = (count != 0).then_some(count);
                        client = Some(Client { to: from, left });
                        due = bench.now();
                    }
                    0x42 => bench.tare(),
                    _ => {}
                }
            }
            let now = bench.now();
            let Some(Client { to, left }) = &mut client else {
                std::thread::sleep(LOOK);
                continue;
            };
            if due > now {
                std::thread::sleep((due - now).min(LOOK));
                continue;
            }
            let to = *to;
            if let Some(left) = left {
                *left -= 1;
                if *left == 0 {
                    client = None;
                }
            }
            due += Duration::from_secs(1) / RATE_HZ;
            number = number.wrapping_add(match bench.is_faulty(Device::Force, FaultKind::Gap) {
                true => SKIPPED,
                false => 1,
            });
            if !bench.is_faulty(Device::Force, FaultKind::Frozen) {
                let force_n = self.setup.drifted_n(Base::turn(bench.reading_n()), now);
                let wrench = self.setup.wrench(force_n);
                shown = self.setup.passed(shown, wrench);
            }
            std::thread::sleep(bench.delay(Device::Force));
            if bench.withholds(Device::Force) {
                continue;
            }
            // Integers have no NaN: a faulty gauge is an error in the status.
            let mut status = match bench.is_faulty(Device::Force, FaultKind::NotANumber) {
                true => ERROR,
                false => self.status.load(Ordering::Acquire),
            };
            let mut values = shown;
            if bench.is_faulty(Device::Force, FaultKind::Saturated) {
                values[2] = -range_n;
                status = ERROR | SATURATED;
            }
            for (kind, datagram) in [(FaultKind::Foreign, FOREIGN), (FaultKind::Hostile, HOSTILE)] {
                if bench.is_faulty(Device::Force, kind) {
                    let _ = socket.send_to(datagram, to);
                }
            }
            let _ = socket.send_to(&record(number, status, values), to);
        }
    }
}

/// Status bit of an error. [`SATURATED`] is the bit of a gauge at the end of its range.
const ERROR: u32 = 1 << 31;
const SATURATED: u32 = 1 << 17;
/// Increment of the record number under the fault that skips numbers.
const SKIPPED: u32 = 7;
/// A datagram of another protocol.
const FOREIGN: &[u8] = b"HTTP/1.1 400 Bad Request\r\nContent-Length: 0\r\n";
/// A truncated record.
const HOSTILE: &[u8] = &[0xff; 35];

fn record(number: u32, status: u32, wrench: [f64; 6]) -> Vec<u8> {
    #[expect(
        clippy::cast_possible_truncation,
        reason = "a cast saturates, and forces are some newtons"
    )]
    let counts = wrench.map(|value| (value * COUNTS).round() as i32);
    // The second number counts measurements; the box sends every n-th.
    let measured = number.wrapping_mul(INTERNAL_HZ / RATE_HZ);
    let heads = [number, measured, status]
        .into_iter()
        .flat_map(u32::to_be_bytes);
    heads
        .chain(counts.into_iter().flat_map(i32::to_be_bytes))
        .collect()
}
