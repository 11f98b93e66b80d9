//! Outside resources that a plugin needs. A child process can access only resources that the manifest declares and the user allows.

mod coverage;
mod declaration;
#[cfg(test)]
mod tests;

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

pub(crate) use self::coverage::matches;
pub use self::declaration::DeclaredNeed;
use taceva_core::suggestion;

use crate::text::shown;

/// Keywords with which the text of a need begins.
const WORDS: [&str; 9] = [
    "camera", "device", "hid", "listen", "read", "serial", "tcp", "udp", "usb",
];

/// Outside resource that a plugin must access.
///
/// ```
/// use taceva_host::Need;
/// let need: Need = "tcp:192.168.1.10:4008".parse()?;
/// assert_eq!(need, Need::Tcp { address: "192.168.1.10".to_owned(), port: 4008 });
/// assert_eq!(need.to_string(), "tcp:192.168.1.10:4008");
///
/// let every: Need = "tcp:192.168.1.*:4008".parse()?;
/// assert!(every.covers(&need) && !need.covers(&every));
/// # Ok::<(), taceva_host::NeedError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
#[non_exhaustive]
pub enum Need {
    /// USB devices.
    Usb,
    /// Cameras with a system driver: `/dev/video*`.
    Camera,
    /// Human interface devices, such as scales and pedals: `/dev/hidraw*`.
    Hid,
    /// Serial ports at a path below `/dev`. `*` stands for any characters except `/`.
    Serial {
        /// Path of the device.
        path: String,
    },
    /// Character devices: a path below `/dev`. `*` stands for any characters except `/`.
    Device {
        /// Path of the device.
        path: String,
    },
    /// TCP servers at one address. `*` stands for any characters except `.`.
    Tcp {
        /// Address or host name.
        address: String,
        /// Port number.
        port: u16,
    },
    /// UDP peers, with addresses as for TCP.
    Udp {
        /// Address or host name.
        address: String,
        /// Port number.
        port: u16,
    },
    /// TCP port of this machine on which the plugin listens.
    Listen {
        /// Port number.
        port: u16,
    },
    /// Read access to a file, or to a folder and everything in it.
    Read {
        /// Absolute path. `*` stands for any characters except `/`.
        path: String,
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
            None if text == "camera" => Ok(Need::Camera),
            None if text == "hid" => Ok(Need::Hid),
            Some(("serial", path)) if is_device(path) => Ok(Need::Serial {
                path: path.to_owned(),
            }),
            Some(("serial", _)) => Err(refused(
                "expected a path below /dev without `..`, such as `serial:/dev/ttyUSB*`",
            )),
            Some(("device", path)) if is_device(path) && names_something(path) => {
                Ok(Need::Device {
                    path: path.to_owned(),
                })
            }
            Some(("device", _)) => Err(refused(
                "expected a path below /dev without `..` or a component that is `*` alone, such as `device:/dev/spidev0.*`",
            )),
            Some(("read", path)) if is_readable(path) => Ok(Need::Read {
                path: path.to_owned(),
            }),
            Some(("read", _)) => Err(refused(
                "expected an absolute path outside /dev, /proc and /sys, without `..` or a component that is `*` alone, such as `read:/run/scale`",
            )),
            Some(("listen", port)) => port_of(port)
                .map(|port| Need::Listen { port })
                .ok_or_else(|| refused("expected a port from 1 to 65535, such as `listen:5025`")),
            Some((kind @ ("tcp" | "udp"), peer)) => {
                let (address, port) = peer_of(peer)
                    .ok_or_else(|| refused("expected `ADDRESS:PORT` after the first colon"))?;
                Ok(match kind {
                    "tcp" => Need::Tcp { address, port },
                    _ => Need::Udp { address, port },
                })
            }
            _ => {
                let kind = text.split(':').next().unwrap_or(text);
                Err(refused(&suggestion(kind, &WORDS)))
            }
        }
    }
}

fn is_device(path: &str) -> bool {
    path.strip_prefix("/dev/").is_some_and(is_path)
}

/// True for names joined by `/`. Braces are reserved for arguments, see [`DeclaredNeed`].
fn is_path(path: &str) -> bool {
    let is_plain = |part: &str| !part.is_empty() && part != "." && part != "..";
    let is_foreign = |letter: char| letter.is_control() || matches!(letter, '{' | '}');
    path.split('/').all(is_plain) && !path.contains(is_foreign)
}

/// False if a part of `path` consists only of stars.
fn names_something(path: &str) -> bool {
    let mut parts = path.split('/').skip(1);
    parts.all(|part| part.chars().any(|letter| letter != '*'))
}

/// True for an absolute path outside `/dev`, `/proc` and `/sys`, which would reveal devices or other processes.
fn is_readable(path: &str) -> bool {
    let first = path.split('/').nth(1).unwrap_or_default();
    let shows_system = ["dev", "proc", "sys"]
        .iter()
        .any(|name| matches(first, name));
    path.strip_prefix('/').is_some_and(is_path) && names_something(path) && !shows_system
}

/// Parses an address or host name and a port above 0. An IPv6 address is in brackets.
fn peer_of(text: &str) -> Option<(String, u16)> {
    let (address, port) = text.rsplit_once(':')?;
    let is_name =
        |letter: char| letter.is_ascii_alphanumeric() || matches!(letter, '.' | '-' | '*');
    let is_ipv6 = address
        .strip_prefix('[')
        .and_then(|rest| rest.strip_suffix(']'))
        .is_some_and(|inside| inside.parse::<std::net::Ipv6Addr>().is_ok());
    // An address of only stars and dots would match every host.
    let names_something = address.contains(|letter: char| letter.is_ascii_alphanumeric());
    let is_address = is_ipv6 || (names_something && address.chars().all(is_name));
    is_address.then_some((address.to_owned(), port_of(port)?))
}

fn port_of(text: &str) -> Option<u16> {
    let is_plain = text.bytes().all(|byte| byte.is_ascii_digit());
    text.parse().ok().filter(|port| is_plain && *port > 0)
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
            Need::Camera => f.write_str("camera"),
            Need::Hid => f.write_str("hid"),
            Need::Serial { path } => write!(f, "serial:{path}"),
            Need::Device { path } => write!(f, "device:{path}"),
            Need::Tcp { address, port } => write!(f, "tcp:{address}:{port}"),
            Need::Udp { address, port } => write!(f, "udp:{address}:{port}"),
            Need::Listen { port } => write!(f, "listen:{port}"),
            Need::Read { path } => write!(f, "read:{path}"),
        }
    }
}

/// Invalid need.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`{}`: {problem}", shown(.text))]
pub struct NeedError {
    text: String,
    problem: String,
}

impl NeedError {
    fn new(text: &str, problem: impl Into<String>) -> NeedError {
        NeedError {
            text: text.to_owned(),
            problem: problem.into(),
        }
    }
}
