//! UDP socket of a Net F/T box: sends requests. A separate thread reads the records.

use std::io;
use std::net::{Ipv4Addr, Ipv6Addr, SocketAddr, ToSocketAddrs, UdpSocket};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;
use std::time::Duration;

use super::record::{RECORD, Record, Request, later_by};
use crate::link::{LinkError, Mailbox, monotonic};

/// UDP socket that receives the records of one Net F/T box.
#[derive(Debug)]
pub(super) struct RecordStream {
    socket: UdpSocket,
    address: SocketAddr,
    is_over: Arc<AtomicBool>,
    reader: Option<JoinHandle<()>>,
}

/// Record, with the number of records lost since the socket was opened.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Counted {
    pub(super) record: Record,
    /// Number of records lost since the socket was opened, computed from gaps in the sequence numbers.
    pub(super) missing: u64,
}

/// Interval at which the reader thread checks the flag that ends it.
const LOOK: Duration = Duration::from_millis(50);
/// Maximum number of records in a datagram.
const RECORDS_MAX: usize = 64;

impl RecordStream {
    /// Opens a socket that accepts only datagrams from `port` of `host`. A thread posts the received records to `records`.
    pub(super) fn open(
        host: &str,
        port: u16,
        records: &Arc<Mailbox<Counted>>,
    ) -> Result<RecordStream, LinkError> {
        let unresolved = |source| LinkError::Resolve {
            host: host.to_owned(),
            source,
        };
        let mut addresses = (host, port).to_socket_addrs().map_err(unresolved)?;
        let none = || unresolved(io::Error::other("no address found"));
        let address = addresses.next().ok_or_else(none)?;
        let own = match address {
            SocketAddr::V4(_) => SocketAddr::from((Ipv4Addr::UNSPECIFIED, 0)),
            SocketAddr::V6(_) => SocketAddr::from((Ipv6Addr::UNSPECIFIED, 0)),
        };
        let refused = |source| LinkError::Connect { address, source };
        let socket = UdpSocket::bind(own).map_err(refused)?;
        // A connected socket receives only datagrams of this address.
        socket.connect(address).map_err(refused)?;
        socket.set_read_timeout(Some(LOOK)).map_err(refused)?;
        let reading = socket.try_clone().map_err(refused)?;
        let is_over = Arc::new(AtomicBool::new(false));
        let (over, posting) = (Arc::clone(&is_over), Arc::clone(records));
        let reader = std::thread::Builder::new()
            .name("netft records".to_owned())
            .spawn(move || {
                if let Err(source) = read(&reading, &over, &posting) {
                    posting.end(LinkError::Broken { address, source }.into());
                }
            })
            .map_err(refused)?;
        Ok(RecordStream {
            socket,
            address,
            is_over,
            reader: Some(reader),
        })
    }

    /// Sends a request. The box does not reply.
    pub(super) fn send(&self, request: Request) -> Result<(), LinkError> {
        let sent = self.socket.send(&request.bytes());
        sent.map(drop).map_err(|source| LinkError::Broken {
            address: self.address,
            source,
        })
    }
}

impl Drop for RecordStream {
    fn drop(&mut self) {
        let _ = self.send(Request::Stop);
        self.is_over.store(true, Ordering::Release);
        if let Some(reader) = self.reader.take() {
            let _ = reader.join();
        }
    }
}

/// Posts the newest record of each datagram to `posting`, until `is_over` is set or the socket fails.
fn read(socket: &UdpSocket, is_over: &AtomicBool, posting: &Mailbox<Counted>) -> io::Result<()> {
    // One extra byte, so that an oversized datagram is not a multiple of the record size.
    let mut bytes = [0; RECORDS_MAX * RECORD + 1];
    let mut last: Option<u32> = None;
    let mut missing = 0;
    while !is_over.load(Ordering::Acquire) {
        let count = match socket.recv(&mut bytes) {
            Ok(count) => count,
            Err(error) => match error.kind() {
                io::ErrorKind::WouldBlock
                | io::ErrorKind::TimedOut
                | io::ErrorKind::Interrupted => continue,
                _ => return Err(error),
            },
        };
        let at = monotonic();
        let (mut came, mut newest) = (0, None);
        for record in Record::all(&bytes[..count]) {
            let step = last.map_or(1, |last| later_by(record.number, last));
            if step <= 0 && step > -REORDERED_MAX {
                // Overtaken or duplicate.
                continue;
            }
            // A much older number means that the box restarted its count.
            missing += u64::try_from(step - 1).unwrap_or(0);
            last = Some(record.number);
            came += 1;
            newest = Some(Counted { record, missing });
        }
        if let Some(newest) = newest {
            posting.post_last(came, newest, at);
        }
    }
    Ok(())
}

/// Sequence-number lag at which a record counts as the first after a restart of the box. A record with a smaller lag is reordered.
const REORDERED_MAX: i32 = 1_000;
