//! Emulated interface box of SRI: commands and a stream of frames on one port.
//!
//! The box supports queries of the decoupling matrix and its unit, and commands for rate, checksums (sum or CRC32), engineering units, start, stop
//! and zero. Zero is not answered while the box streams, as public drivers report. Counts, several readings per frame, and persistent settings are
//! not supported.

mod session;

use std::net::{Ipv4Addr, SocketAddr};

use crate::bench::WallBench;
use crate::error::WireError;
use crate::server::{End, Server};

/// Emulated interface box of SRI that listens until drop.
#[derive(Debug)]
pub struct Emulator {
    server: Server,
    force_max_n: f64,
}

/// The port that clients expect.
pub const USUAL_PORT: u16 = 4008;

impl Emulator {
    /// Starts a box whose transducer measures the force on the gel of `bench`; port 0 selects any free port.
    ///
    /// # Errors
    /// [`WireError`] if the server cannot listen on the port.
    pub fn start(bench: &WallBench, host: Ipv4Addr, port: u16) -> Result<Emulator, WireError> {
        let end = End::default();
        let serving = (bench.clone(), end.clone());
        let server = Server::start(host, port, &end, move |stream| {
            session::serve(stream, &serving.0, &serving.1);
        })?;
        Ok(Emulator {
            server,
            force_max_n: bench.force_range_n(),
        })
    }

    /// Selector of the driver for this box, with its arguments.
    pub fn selector(&self) -> String {
        let address = self.address();
        format!(
            "sri/m8128:host={};port={};force_max_n={}",
            address.ip(),
            address.port(),
            self.force_max_n
        )
    }

    /// Address of the server.
    pub fn address(&self) -> SocketAddr {
        self.server.address()
    }
}
