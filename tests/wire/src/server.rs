//! Listening ports: one thread for each port and for each client, and the flag that ends these threads.

use std::io;
use std::net::{Ipv4Addr, SocketAddr, SocketAddrV4, TcpListener, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;
use std::time::Duration;

use crate::error::WireError;

/// A loopback port that listens until drop.
#[derive(Debug)]
pub(crate) struct Server {
    address: SocketAddr,
    end: End,
    listener: Option<JoinHandle<()>>,
}

/// End flag of a server, shared by its threads.
#[derive(Clone, Debug, Default)]
pub(crate) struct End(Arc<AtomicBool>);

impl End {
    pub(crate) fn has_come(&self) -> bool {
        self.0.load(Ordering::Acquire)
    }

    pub(crate) fn come(&self) {
        self.0.store(true, Ordering::Release);
    }
}

/// Interval at which a thread that waits for a client checks for the end.
const LOOK: Duration = Duration::from_millis(5);
/// Longest time that a client without reads may block its thread. The time is long, because a busy processor delays clients.
const WRITING: Duration = Duration::from_secs(30);

impl Server {
    /// Listens on `port` of `host`, a loopback address; port 0 selects any port. `serve` is called on a separate thread for each client.
    pub(crate) fn start(
        host: Ipv4Addr,
        port: u16,
        end: &End,
        serve: impl Fn(TcpStream) + Clone + Send + 'static,
    ) -> Result<Server, WireError> {
        let wanted = SocketAddrV4::new(host, port);
        let refused = |source| WireError::Listen {
            address: wanted.to_string(),
            source,
        };
        if !host.is_loopback() {
            return Err(refused(io::Error::other(
                "expected an address of loopback, such as 127.0.0.1",
            )));
        }
        let listener = TcpListener::bind(wanted).map_err(refused)?;
        let address = listener.local_addr().map_err(refused)?;
        listener.set_nonblocking(true).map_err(refused)?;
        let over = end.clone();
        let thread = std::thread::Builder::new()
            .name(format!("port {}", address.port()))
            .spawn(move || {
                while !over.has_come() {
                    let Ok((stream, _)) = listener.accept() else {
                        std::thread::sleep(LOOK);
                        continue;
                    };
                    let serve = serve.clone();
                    // A client that cannot be served counts as absent.
                    let prepared = prepare(&stream);
                    if prepared.is_ok() {
                        let _ = std::thread::Builder::new().spawn(move || serve(stream));
                    }
                }
            })
            .map_err(WireError::Thread)?;
        Ok(Server {
            address,
            end: end.clone(),
            listener: Some(thread),
        })
    }

    pub(crate) fn address(&self) -> SocketAddr {
        self.address
    }
}

fn prepare(stream: &TcpStream) -> io::Result<()> {
    stream.set_nonblocking(false)?;
    stream.set_nodelay(true)?;
    stream.set_write_timeout(Some(WRITING))?;
    stream.set_read_timeout(Some(READING))
}

/// Interval at which a thread that waits for its client checks for the end.
const READING: Duration = Duration::from_millis(50);

/// Reads once: `None` without data from an open client, 0 bytes after the client or the server has closed.
pub(crate) fn read(stream: &mut impl io::Read, bytes: &mut [u8], end: &End) -> Option<usize> {
    if end.has_come() {
        return Some(0);
    }
    match stream.read(bytes) {
        Ok(count) => Some(count),
        Err(error) => match error.kind() {
            io::ErrorKind::WouldBlock | io::ErrorKind::TimedOut | io::ErrorKind::Interrupted => {
                None
            }
            _ => Some(0),
        },
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        self.end.come();
        if let Some(listener) = self.listener.take() {
            let _ = listener.join();
        }
    }
}
