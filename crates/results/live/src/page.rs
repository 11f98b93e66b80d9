//! HTTP server of a page.

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

/// Timeout for writing a response to a browser.
const WRITING: Duration = Duration::from_secs(2);
/// Interval at which the encoder checks for the end of the page.
const LOOK: Duration = Duration::from_millis(100);
/// Delay at the end of the page, in which browsers receive the last event.
const LAST_WORD: Duration = Duration::from_millis(400);

/// A page on `127.0.0.1`, served until it is dropped.
pub struct Page {
    address: SocketAddr,
    token: Token,
    shared: Arc<Shared>,
    connections: Arc<AtomicUsize>,
    threads: Vec<JoinHandle<()>>,
}

impl Page {
    /// Serves `live` on `port` of loopback, 0 for any free port. A thread of the page calls `on_stop` whenever a user presses the stop button. `on_stop` must
    /// return at once.
    ///
    /// # Errors
    /// [`PageError`] if the port is taken, no thread starts, or the system provides no random numbers.
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

    /// URL for a browser. The part after `#` is the token.
    pub fn url(&self) -> String {
        format!("http://{}/#{}", self.address, self.token.text())
    }

    /// Loopback address and port on which the server listens.
    pub fn address(&self) -> SocketAddr {
        self.address
    }
}

impl Drop for Page {
    fn drop(&mut self) {
        self.shared.is_over.store(true, Ordering::Release);
        // Wakes the thread that accepts connections.
        drop(TcpStream::connect(self.address));
        for thread in self.threads.drain(..) {
            // A panic of the thread was already reported.
            drop(thread.join());
        }
        // Streams send a last event with the end of the run.
        let began = std::time::Instant::now();
        while self.connections.load(Ordering::Acquire) > 0 && began.elapsed() < LAST_WORD {
            std::thread::sleep(Duration::from_millis(5));
        }
    }
}

/// Starts a thread for every connection. Connections without the token are limited, so that the server always answers the stop button.
fn accept(listener: &TcpListener, site: &Arc<Site>, connections: &Arc<AtomicUsize>) {
    let strangers = Arc::new(Strangers::default());
    loop {
        let accepted = listener.accept();
        if site.shared.is_over.load(Ordering::Acquire) {
            return;
        }
        let Ok((stream, _)) = accepted else {
            // Too many files are open, or the client has already gone.
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
        // If the thread does not start, the connection is closed.
        let _ = std::thread::Builder::new()
            .name("page connection".to_owned())
            .spawn(move || {
                let (site, _leaves) = served;
                // Errors mean that the browser has gone.
                let _ = route::serve(stream, stranger, &site);
            });
    }
}

/// Decrements the number of open connections on drop.
struct Leaves(Arc<AtomicUsize>);

impl Leaves {
    /// Increments the number of open connections. Dropping the result decrements the number.
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
