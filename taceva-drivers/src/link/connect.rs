//! TCP connections with a timeout.

use std::io;
use std::net::{SocketAddr, TcpStream, ToSocketAddrs};
use std::time::Duration;

use super::LinkError;

/// Timeout per address. Laboratory devices answer in milliseconds.
const PATIENCE: Duration = Duration::from_secs(2);

/// Connects to `port` of `host`, with `TCP_NODELAY`, so that small messages are not delayed.
///
/// # Errors
/// [`LinkError`] if the host is unknown, the connection is refused, or no answer arrives within 2 s per address.
pub(crate) fn connect(host: &str, port: u16) -> Result<(TcpStream, SocketAddr), LinkError> {
    let unresolved = |source| LinkError::Resolve {
        host: host.to_owned(),
        source,
    };
    let addresses = (host, port).to_socket_addrs().map_err(unresolved)?;
    let mut refused = None;
    for address in addresses {
        match open(address) {
            Ok(stream) => return Ok((stream, address)),
            Err(source) => refused = Some(LinkError::Connect { address, source }),
        }
    }
    Err(refused.unwrap_or_else(|| unresolved(io::Error::other("no address found"))))
}

fn open(address: SocketAddr) -> io::Result<TcpStream> {
    let stream = TcpStream::connect_timeout(&address, PATIENCE)?;
    stream.set_nodelay(true)?;
    Ok(stream)
}

#[cfg(test)]
mod tests {
    use std::net::TcpListener;

    use taceva_core::ErrorKind;

    use super::*;

    #[test]
    fn a_port_where_nobody_listens_is_not_found_and_named() {
        let listener = TcpListener::bind("127.0.0.1:0").expect("a port");
        let port = listener.local_addr().expect("bound").port();
        assert!(connect("127.0.0.1", port).is_ok());
        drop(listener);
        let error = connect("127.0.0.1", port).expect_err("nobody listens");
        assert_eq!(error.kind(), ErrorKind::NotFound);
        assert!(error.to_string().contains(&format!("127.0.0.1:{port}")));
    }

    #[test]
    fn a_name_that_is_none_is_said_with_its_control_characters_written_out() {
        let error = connect("no\u{1b} name", 1).expect_err("no such name");
        assert_eq!(error.kind(), ErrorKind::NotFound);
        let message = error.to_string();
        assert!(message.contains("no\\u{1b} name"), "{message}");
    }
}
