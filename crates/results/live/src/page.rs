//! The server of a page, while somebody has it.

use std::io;
use std::net::{Ipv4Addr, SocketAddr, TcpListener, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread::JoinHandle;
use std::time::Duration;

use crate::access::Access;
use crate::error::PageError;
use crate::live::{Live, Shared};
use crate::route::{self, Site};
use crate::strangers::Strangers;
use crate::token::Token;

/// How long a browser that takes nothing may hold its thread.
const WRITING: Duration = Duration::from_secs(2);
/// How long the encoder waits for a frame before it looks whether it is over.
const LOOK: Duration = Duration::from_millis(100);
/// How long the last word may take to reach the browsers.
const LAST_WORD: Duration = Duration::from_millis(400);

/// A page on `127.0.0.1`, until this is dropped.
pub struct Page {
    address: SocketAddr,
    token: Token,
    shared: Arc<Shared>,
    connections: Arc<AtomicUsize>,
    threads: Vec<JoinHandle<()>>,
}

impl Page {
    /// Shows `live` on `port` of loopback, 0 for any; `on_stop` is called on a thread of the page whenever somebody presses stop, and returns
    /// at once.
    ///
    /// # Errors
    /// [`PageError`] if the port is taken, no thread starts, or the system has no random numbers.
    pub fn open(
        live: &Live,
        port: u16,
        on_stop: impl Fn() + Send + Sync + 'static,
    ) -> Result<Page, PageError> {
        let refused = |source: io::Error| PageError::Listen { port, source };
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port)).map_err(refused)?;
        let address = listener.local_addr().map_err(refused)?;
        let token = Token::random()?;
        let shared = Arc::clone(&live.shared);
        let connections = Arc::new(AtomicUsize::new(0));
        let site = Arc::new(Site {
            access: Access::new(address.port(), token.clone()),
            shared: Arc::clone(&shared),
            on_stop: Box::new(on_stop),
        });
        let thread = |name: &str, work: Box<dyn FnOnce() + Send>| {
            let thread = std::thread::Builder::new().name(format!("page {name}"));
            thread.spawn(work).map_err(PageError::Thread)
        };
        let encoded = Arc::clone(&shared);
        let encoder = move || {
            while !encoded.is_over.load(Ordering::Acquire) {
                match encoded.viewers.load(Ordering::Acquire) {
                    0 => std::thread::sleep(LOOK),
                    _ => encoded.frames.encode_next(LOOK),
                }
            }
        };
        let counted = Arc::clone(&connections);
        let encoder = thread("encoder", Box::new(encoder))?;
        let accepting = thread(
            "listener",
            Box::new(move || accept(&listener, &site, &counted)),
        );
        let mut page = Page {
            address,
            token,
            shared,
            connections,
            threads: vec![encoder],
        };
        page.threads.push(accepting?);
        Ok(page)
    }

    /// The address that a browser opens; the part behind `#` is the token.
    pub fn url(&self) -> String {
        format!("http://{}/#{}", self.address, self.token.text())
    }

    /// The address and port that it listens on, always of loopback.
    pub fn address(&self) -> SocketAddr {
        self.address
    }
}

impl Drop for Page {
    fn drop(&mut self) {
        self.shared.is_over.store(true, Ordering::Release);
        // Wakes who waits for a connection.
        drop(TcpStream::connect(self.address));
        for thread in self.threads.drain(..) {
            // One that panicked has said so.
            drop(thread.join());
        }
        // Streams have a last event to send, which says how it ended.
        let began = std::time::Instant::now();
        while self.connections.load(Ordering::Acquire) > 0 && began.elapsed() < LAST_WORD {
            std::thread::sleep(Duration::from_millis(5));
        }
    }
}

/// Gives every connection a thread. One that has not shown the token may be closed for a newer one, so that the stop button is always answered.
fn accept(listener: &TcpListener, site: &Arc<Site>, connections: &Arc<AtomicUsize>) {
    let strangers = Arc::new(Strangers::default());
    loop {
        let accepted = listener.accept();
        if site.shared.is_over.load(Ordering::Acquire) {
            return;
        }
        let Ok((stream, _)) = accepted else {
            // Too many files are open, or the client is gone already.
            std::thread::sleep(Duration::from_millis(5));
            continue;
        };
        let prepared = stream
            .set_nodelay(true)
            .and_then(|()| stream.set_write_timeout(Some(WRITING)));
        if prepared.is_err() {
            continue;
        }
        let Ok(stranger) = strangers.enter(&stream) else {
            continue;
        };
        let served = (Arc::clone(site), Leaves::enter(connections));
        // A thread that does not start is a connection that is closed.
        let _ = std::thread::Builder::new()
            .name("page connection".to_owned())
            .spawn(move || {
                let (site, _leaves) = served;
                // A browser that goes ends its connection.
                let _ = route::serve(stream, stranger, &site);
            });
    }
}

/// Counts a connection off, however it ends.
struct Leaves(Arc<AtomicUsize>);

impl Leaves {
    /// Counts a connection on.
    fn enter(connections: &Arc<AtomicUsize>) -> Leaves {
        connections.fetch_add(1, Ordering::AcqRel);
        Leaves(Arc::clone(connections))
    }
}

impl Drop for Leaves {
    fn drop(&mut self) {
        self.0.fetch_sub(1, Ordering::AcqRel);
    }
}
