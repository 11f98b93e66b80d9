//! What a plugin needs beyond computing: nothing of it is given in a child process unless its manifest says so and the user agrees.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use crate::shown::{shown, suggestion};

/// Something outside the plugin that it must reach.
///
/// ```
/// use taceva_host::Need;
/// let need: Need = "tcp:192.168.1.10:4008".parse()?;
/// assert_eq!(need, Need::Tcp { address: "192.168.1.10".to_owned(), port: 4008 });
/// assert_eq!(need.to_string(), "tcp:192.168.1.10:4008");
/// # Ok::<(), taceva_host::NeedError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
#[non_exhaustive]
pub enum Need {
    /// Devices on USB.
    Usb,
    /// Serial ports: a path below `/dev`, in which `*` stands for anything but `/`.
    Serial {
        /// The path.
        path: String,
    },
    /// One TCP server.
    Tcp {
        /// Its address or name.
        address: String,
        /// Its port.
        port: u16,
    },
    /// One UDP peer.
    Udp {
        /// Its address or name.
        address: String,
        /// Its port.
        port: u16,
    },
}

impl FromStr for Need {
    type Err = NeedError;

    fn from_str(text: &str) -> Result<Need, NeedError> {
        let refused = |problem: &str| NeedError {
            text: text.to_owned(),
            problem: problem.to_owned(),
        };
        match text.split_once(':') {
            None if text == "usb" => Ok(Need::Usb),
            Some(("serial", path)) if is_device(path) => Ok(Need::Serial {
                path: path.to_owned(),
            }),
            Some(("serial", _)) => Err(refused(
                "expected a path below /dev without `..`, such as `serial:/dev/ttyUSB*`",
            )),
            Some((kind @ ("tcp" | "udp"), peer)) => {
                let (address, port) =
                    peer_of(peer).ok_or_else(|| refused("expected `ADDRESS:PORT` after it"))?;
                Ok(match kind {
                    "tcp" => Need::Tcp { address, port },
                    _ => Need::Udp { address, port },
                })
            }
            _ => {
                let kind = text.split(':').next().unwrap_or(text);
                Err(refused(&suggestion(kind, &["usb", "serial", "tcp", "udp"])))
            }
        }
    }
}

fn is_device(path: &str) -> bool {
    let is_plain = |part: &str| !part.is_empty() && part != "." && part != "..";
    match path.strip_prefix("/dev/") {
        Some(rest) => rest.split('/').all(is_plain) && !rest.contains(char::is_control),
        None => false,
    }
}

/// An address or a host's name, and a port that is not 0; an IPv6 address stands in brackets.
fn peer_of(text: &str) -> Option<(String, u16)> {
    let (address, port) = text.rsplit_once(':')?;
    let is_name = |letter: char| letter.is_ascii_alphanumeric() || matches!(letter, '.' | '-');
    let is_ipv6 = address
        .strip_prefix('[')
        .and_then(|rest| rest.strip_suffix(']'))
        .is_some_and(|inside| inside.parse::<std::net::Ipv6Addr>().is_ok());
    let is_address = is_ipv6 || (!address.is_empty() && address.chars().all(is_name));
    let port = port.parse().ok().filter(|port| *port > 0)?;
    is_address.then(|| (address.to_owned(), port))
}

impl TryFrom<String> for Need {
    type Error = NeedError;

    fn try_from(text: String) -> Result<Need, NeedError> {
        text.parse()
    }
}

impl From<Need> for String {
    fn from(need: Need) -> String {
        need.to_string()
    }
}

impl fmt::Display for Need {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Need::Usb => f.write_str("usb"),
            Need::Serial { path } => write!(f, "serial:{path}"),
            Need::Tcp { address, port } => write!(f, "tcp:{address}:{port}"),
            Need::Udp { address, port } => write!(f, "udp:{address}:{port}"),
        }
    }
}

/// Text that names nothing a plugin may need.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`{}`: {problem}", shown(.text))]
pub struct NeedError {
    text: String,
    problem: String,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_need_reads_back_as_it_is_written() {
        for text in [
            "usb",
            "serial:/dev/ttyUSB*",
            "tcp:sensor.local:4008",
            "udp:[fe80::1]:49152",
        ] {
            let need: Need = text.parse().expect(text);
            assert_eq!(need.to_string(), text);
        }
    }

    #[test]
    fn what_could_reach_further_than_it_says_is_refused() {
        for (text, expected) in [
            ("usbs", "did you mean `usb`?"),
            ("usb:1", "did you mean `usb`?"),
            ("serial:/etc/passwd", "below /dev"),
            ("serial:/dev/../etc/passwd", "below /dev"),
            ("serial:/dev/", "below /dev"),
            ("tcp:10.0.0.1", "ADDRESS:PORT"),
            ("tcp:10.0.0.1:0", "ADDRESS:PORT"),
            ("tcp:10.0.0.1:65536", "ADDRESS:PORT"),
            ("udp::5", "ADDRESS:PORT"),
            ("everything", "expected one of"),
        ] {
            let error = text.parse::<Need>().expect_err(text).to_string();
            assert!(error.contains(expected), "{error}");
        }
    }
}
