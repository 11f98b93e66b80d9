//! Need declared in a manifest: fixed, or bound to the arguments with which a device is opened.

use std::fmt;

use taceva_core::Args;

use super::{Need, NeedError};

/// Need of a manifest. An argument key in braces may replace an address, a port or a path: `tcp:{host}:{port}`.
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
    /// Text of the need. With example values for its arguments, the text is a valid need.
    text: String,
}

impl DeclaredNeed {
    /// The need, if it has no argument in braces; `None` otherwise.
    pub fn fixed(&self) -> Option<Need> {
        self.text.parse().ok()
    }

    /// Keys of the arguments in braces.
    pub fn arguments(&self) -> impl Iterator<Item = &str> {
        fields(&self.text).into_iter().filter_map(key)
    }

    /// Key of the argument that names the host; `None` if there is none.
    pub(crate) fn host_argument(&self) -> Option<&str> {
        match fields(&self.text).as_slice() {
            ["tcp" | "udp", address, _] => key(address),
            _ => None,
        }
    }

    /// Need of a device that is opened with `args`; `None` if an argument is missing.
    ///
    /// # Errors
    /// [`NeedError`] for an argument that is not a valid part of a need or contains a `*`.
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
        // An argument selects one resource. Stars are only for manifests and user settings.
        if need.has_star() && self.fixed().is_none() {
            return Err(NeedError::new(
                &text,
                "an argument names one resource, expected no `*`",
            ));
        }
        Ok(Some(need))
    }

    /// True if `need` is part of this declaration or includes it, so that a permission for `need` has an effect.
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

/// Splits a need into its first word and the rest. The rest of `tcp` and `udp` is split into address and port.
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

/// Key of the argument in braces; `None` for other text.
fn key(field: &str) -> Option<&str> {
    field.strip_prefix('{')?.strip_suffix('}')
}

/// Replaces each argument of `text` by `value(key, field index)`.
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

/// Example value for the field with this index.
fn example(text: &str, field: usize) -> &'static str {
    match (text.split(':').next(), field) {
        (Some("tcp" | "udp"), 1) => "host",
        (Some("tcp" | "udp"), _) | (Some("listen"), _) => "1",
        (Some("read"), _) => "/file",
        _ => "/dev/device",
    }
}

/// Puts an IPv6 address into brackets.
fn bracketed(value: String) -> String {
    match value.parse::<std::net::Ipv6Addr>() {
        Ok(_) => format!("[{value}]"),
        Err(_) => value,
    }
}
