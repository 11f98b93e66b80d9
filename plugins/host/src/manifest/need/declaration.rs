//! A need as a manifest declares it: fixed, or decided by the arguments that a device is opened with.

use std::fmt;

use taceva_core::Args;

use super::{Need, NeedError};

/// A need of a manifest, in which the key of an argument in braces may stand for an address, a port or a path: `tcp:{host}:{port}`.
///
/// ```
/// use taceva_core::{ArgSpec, ArgValue, Args};
/// use taceva_host::DeclaredNeed;
/// let declared: DeclaredNeed = "tcp:{host}:{port}".parse()?;
/// let specs = [
///     ArgSpec::text("host"),
///     ArgSpec::whole("port", 1, 65_535).default(ArgValue::Whole(502)),
/// ];
/// let args = Args::parse(&specs, "host=10.0.0.5")?;
/// let need = declared.bound_to(&args)?.expect("both are known");
/// assert_eq!(need.to_string(), "tcp:10.0.0.5:502");
/// assert!(declared.asks_for(&need));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct DeclaredNeed {
    /// Checked: with examples in the place of its arguments it is a need.
    text: String,
}

impl DeclaredNeed {
    /// The need, if no argument decides it.
    pub fn fixed(&self) -> Option<Need> {
        self.text.parse().ok()
    }

    /// The keys of the arguments that decide it.
    pub fn arguments(&self) -> impl Iterator<Item = &str> {
        fields(&self.text).into_iter().filter_map(key)
    }

    /// The key of the argument that says which machine is reached, if one does.
    pub(crate) fn host_argument(&self) -> Option<&str> {
        match fields(&self.text).as_slice() {
            ["tcp" | "udp", address, _] => key(address),
            _ => None,
        }
    }

    /// What it is for a device that is opened with `args`; `None` if an argument of it was not given.
    ///
    /// # Errors
    /// [`NeedError`] for an argument that names nothing a plugin may reach, or more than one thing.
    pub fn bound_to(&self, args: &Args) -> Result<Option<Need>, NeedError> {
        let mut is_given = true;
        let text = filled(&self.text, |key, _| {
            let value = args.get(key).map(ToString::to_string);
            is_given &= value.is_some();
            bracketed(value.unwrap_or_default())
        });
        if !is_given {
            return Ok(None);
        }
        let need: Need = text.parse()?;
        // An argument chooses one thing: stars are for manifests and for users.
        if need.has_star() && self.fixed().is_none() {
            return Err(NeedError::new(
                &text,
                "an argument names one thing, expected no `*`",
            ));
        }
        Ok(Some(need))
    }

    /// Whether `need` is a part of what this asks for, or holds it: whether a user who allows it decides about this.
    pub fn asks_for(&self, need: &Need) -> bool {
        if let Some(fixed) = self.fixed() {
            return fixed.covers(need) || need.covers(&fixed);
        }
        let said = need.to_string();
        let (ours, theirs) = (fields(&self.text), fields(&said));
        let mut pairs = ours.iter().zip(&theirs);
        ours.len() == theirs.len() && pairs.all(|(our, their)| key(our).is_some() || our == their)
    }
}

impl std::str::FromStr for DeclaredNeed {
    type Err = NeedError;

    fn from_str(text: &str) -> Result<DeclaredNeed, NeedError> {
        let is_key = |key: &str| {
            let mut letters = key.chars();
            letters
                .next()
                .is_some_and(|letter| letter.is_ascii_lowercase())
                && letters.all(|letter| letter.is_ascii_alphanumeric() || letter == '_')
        };
        if let Some(wrong) = fields(text)
            .into_iter()
            .filter_map(key)
            .find(|key| !is_key(key))
        {
            return Err(NeedError::new(
                text,
                format!("`{{{wrong}}}`: expected the key of an argument in braces"),
            ));
        }
        let example = filled(text, |_, field| example(text, field).to_owned());
        match example.parse::<Need>() {
            Ok(_) => Ok(DeclaredNeed {
                text: text.to_owned(),
            }),
            Err(NeedError { problem, .. }) if text.contains(['{', '}']) => Err(NeedError::new(
                text,
                format!("{problem}; `{{key}}` stands for a whole address, port or path"),
            )),
            Err(NeedError { problem, .. }) => Err(NeedError::new(text, problem)),
        }
    }
}

impl fmt::Display for DeclaredNeed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

/// The word of a need, and what follows it: an address and a port, or all of the rest.
fn fields(text: &str) -> Vec<&str> {
    match text.split_once(':') {
        Some((word @ ("tcp" | "udp"), peer)) => match peer.rsplit_once(':') {
            Some((address, port)) => vec![word, address, port],
            None => vec![word, peer],
        },
        Some((word, rest)) => vec![word, rest],
        None => vec![text],
    }
}

/// The key of the argument that `field` is.
fn key(field: &str) -> Option<&str> {
    field.strip_prefix('{')?.strip_suffix('}')
}

/// `text` with what `value` says for each argument, by its key and the number of its field.
fn filled(text: &str, mut value: impl FnMut(&str, usize) -> String) -> String {
    let fields = fields(text).into_iter().enumerate();
    let fields: Vec<String> = fields
        .map(|(number, field)| match key(field) {
            Some(key) => value(key, number),
            None => field.to_owned(),
        })
        .collect();
    fields.join(":")
}

/// What could stand in the field of that number.
fn example(text: &str, field: usize) -> &'static str {
    match (text.split(':').next(), field) {
        (Some("tcp" | "udp"), 1) => "host",
        (Some("tcp" | "udp"), _) | (Some("listen"), _) => "1",
        (Some("read"), _) => "/file",
        _ => "/dev/device",
    }
}

/// An address of IPv6 as needs write it.
fn bracketed(value: String) -> String {
    match value.parse::<std::net::Ipv6Addr>() {
        Ok(_) => format!("[{value}]"),
        Err(_) => value,
    }
}
