//! The socket of a box: requests out, records in, with a thread of its own that reads.

use std::io;
use std::net::{Ipv4Addr, Ipv6Addr, SocketAddr, ToSocketAddrs, UdpSocket};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;
use std::time::Duration;

use super::record::{RECORD, Record, Request, later_by};
use crate::link::{LinkError, Mailbox, monotonic};

/// A socket that takes records from one box.
#[derive(Debug)]
pub(super) struct RecordStream {
    socket: UdpSocket,
    address: SocketAddr,
    is_over: Arc<AtomicBool>,
    reader: Option<JoinHandle<()>>,
}

/// A record with what went wrong on the way until it came.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Counted {
    pub(super) record: Record,
    /// Records that are missing so far, by the numbers of those that came.
    pub(super) missing: u64,
}

/// How often the thread that reads looks whether it is over.
const LOOK: Duration = Duration::from_millis(50);
/// No box puts more records into one datagram.
const RECORDS_MAX: usize = 64;

impl RecordStream {
    /// A socket that exchanges datagrams with `port` of `host` alone, and posts what comes.
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
        let none = || unresolved(io::Error::other("it names none"));
        let address = addresses.next().ok_or_else(none)?;
        let own = match address {
            SocketAddr::V4(_) => SocketAddr::from((Ipv4Addr::UNSPECIFIED, 0)),
            SocketAddr::V6(_) => SocketAddr::from((Ipv6Addr::UNSPECIFIED, 0)),
        };
        let refused = |source| LinkError::Connect { address, source };
        let socket = UdpSocket::bind(own).map_err(refused)?;
        // From now on datagrams of others do not arrive.
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

    /// Sends a request, which no box answers.
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

/// Posts every record until it is over, or nobody is there any more.
fn read(socket: &UdpSocket, is_over: &AtomicBool, posting: &Mailbox<Counted>) -> io::Result<()> {
    // A byte more, so that a longer datagram is no whole number of records.
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
                // It was overtaken, or comes twice.
                continue;
            }
            // What is far back is no late record but a box that counts anew.
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

/// A network does not mix records up over more than this.
const REORDERED_MAX: i32 = 1_000;
