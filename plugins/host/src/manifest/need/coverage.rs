//! Inclusion of needs: decides whether a permission is sufficient.

use std::collections::BTreeSet;

use super::Need;

impl Need {
    /// True if this need includes every resource of `other`. A `*` matches any characters within one part of `other`, including stars.
    ///
    /// ```
    /// use taceva_host::Need;
    /// let [ports, port]: [Need; 2] = [
    ///     "serial:/dev/ttyUSB*".parse()?,
    ///     "serial:/dev/ttyUSB0".parse()?,
    /// ];
    /// assert!(ports.covers(&port) && !port.covers(&ports));
    /// # Ok::<(), taceva_host::NeedError>(())
    /// ```
    pub fn covers(&self, other: &Need) -> bool {
        match (self, other) {
            (Need::Serial { path }, Need::Serial { path: other })
            | (Need::Device { path }, Need::Device { path: other }) => {
                each_part(path, other, '/', matches)
            }
            (Need::Read { path }, Need::Read { path: other }) => within(path, other),
            (
                Need::Tcp { address, port },
                Need::Tcp {
                    address: other,
                    port: at,
                },
            )
            | (
                Need::Udp { address, port },
                Need::Udp {
                    address: other,
                    port: at,
                },
            ) => port == at && address_covers(address, other),
            _ => self == other,
        }
    }

    /// Part of this need that `allowed` grants: the whole need, or the smaller needs in `allowed`.
    pub(crate) fn given_by(&self, allowed: &BTreeSet<Need>) -> BTreeSet<Need> {
        if allowed.iter().any(|given| given.covers(self)) {
            return BTreeSet::from([self.clone()]);
        }
        let parts = allowed.iter().filter(|given| self.covers(given));
        parts.cloned().collect()
    }

    /// True if the need contains a `*`.
    pub(crate) fn has_star(&self) -> bool {
        match self {
            Need::Serial { path } | Need::Device { path } | Need::Read { path } => {
                path.contains('*')
            }
            Need::Tcp { address, .. } | Need::Udp { address, .. } => address.contains('*'),
            Need::Usb | Need::Camera | Need::Hid | Need::Listen { .. } => false,
        }
    }
}

/// True if `pattern` and `text` have the same number of parts and each part matches.
fn each_part(pattern: &str, text: &str, mark: char, matches: fn(&str, &str) -> bool) -> bool {
    let mut pairs = pattern.split(mark).zip(text.split(mark));
    pattern.split(mark).count() == text.split(mark).count()
        && pairs.all(|(pattern, part)| matches(pattern, part))
}

/// True if `path` matches `pattern` or is below a match.
fn within(pattern: &str, path: &str) -> bool {
    let parts = pattern.split('/').count();
    let begin: Vec<&str> = path.split('/').take(parts).collect();
    each_part(pattern, &begin.join("/"), '/', matches)
}

/// Compares addresses part by part, separated by dots. A numeric pattern such as `10.0.0.*` matches only numeric addresses, not host names.
fn address_covers(pattern: &str, address: &str) -> bool {
    if pattern.starts_with('[') || address.starts_with('[') {
        return pattern == address;
    }
    let is_numeric = |text: &str| {
        let is_digit = |letter: char| letter.is_ascii_digit() || matches!(letter, '.' | '*');
        text.chars().all(is_digit)
    };
    let (pattern, address) = (pattern.to_ascii_lowercase(), address.to_ascii_lowercase());
    (!is_numeric(&pattern) || is_numeric(&address)) && each_part(&pattern, &address, '.', matches)
}

/// True if `name`, one part of a path or of an address, matches `pattern`. A `*` stands for any characters.
pub(crate) fn matches(pattern: &str, name: &str) -> bool {
    let (pattern, name) = (pattern.as_bytes(), name.as_bytes());
    // Position of the last star, and start of its match. A mismatch extends that match by one character.
    let (mut at, mut read) = (0, 0);
    let mut star: Option<(usize, usize)> = None;
    while read < name.len() {
        if pattern.get(at) == Some(&b'*') {
            star = Some((at, read));
            at += 1;
        } else if pattern.get(at) == Some(&name[read]) {
            (at, read) = (at + 1, read + 1);
        } else if let Some((place, taken)) = star {
            star = Some((place, taken + 1));
            (at, read) = (place + 1, taken + 1);
        } else {
            return false;
        }
    }
    pattern[at..].iter().all(|byte| *byte == b'*')
}
