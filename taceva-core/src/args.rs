//! Arguments of a driver: declared as data, parsed from text, and checked before a device is opened.

mod error;
mod kind;
mod spec;
mod value;

use crate::suggestion::nearest;

pub use error::ArgError;
pub use kind::{ArgKind, Presence};
pub use spec::ArgSpec;
pub use value::ArgValue;

use std::collections::BTreeMap;
use std::fmt;

/// Arguments of one driver, checked against the driver's declarations. An omitted argument has its declared default, if any.
///
/// ```
/// use taceva_core::{ArgSpec, ArgValue, Args};
/// let specs = [
///     ArgSpec::whole("seed", 0, i64::MAX).default(ArgValue::Whole(0)).help("seed of the noise"),
///     ArgSpec::number("exposure", 0.1, 33.0).unit("ms").default(ArgValue::Number(8.0)).help("of one frame"),
/// ];
/// let args = Args::parse(&specs, "seed=3;exposure=16 ms")?;
/// assert_eq!((args.whole("seed"), args.number("exposure")), (3, 16.0));
///
/// let error = Args::parse(&specs, "sede=3").unwrap_err();
/// assert_eq!(error.to_string(), "`sede`: unknown argument, did you mean `seed`?");
/// # Ok::<(), taceva_core::ArgError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Args {
    values: BTreeMap<String, ArgValue>,
}

impl Args {
    /// Parses arguments of the form `key=value;key=value` and checks them against `specs`. `;;` stands for a semicolon within a value.
    ///
    /// # Errors
    /// [`ArgError`] for the first invalid argument.
    pub fn parse(specs: &[ArgSpec], text: &str) -> Result<Args, ArgError> {
        let mut pairs = Vec::new();
        for part in parts(text) {
            match part.split_once('=') {
                Some((key, value)) => pairs.push((key.trim().to_owned(), value.trim().to_owned())),
                None => return Err(ArgError::Syntax { text: part }),
            }
        }
        Args::from_pairs(specs, pairs)
    }

    /// Parses and checks arguments given as pairs of key and text, for example the entries of a TOML table.
    ///
    /// # Errors
    /// [`ArgError`] for the first invalid argument.
    pub fn from_pairs(
        specs: &[ArgSpec],
        pairs: impl IntoIterator<Item = (impl AsRef<str>, impl AsRef<str>)>,
    ) -> Result<Args, ArgError> {
        let mut values = BTreeMap::new();
        for (key, text) in pairs {
            let (key, text) = (key.as_ref(), text.as_ref());
            let spec = specs
                .iter()
                .find(|spec| spec.key == key)
                .ok_or_else(|| unknown(key, specs))?;
            let value = spec.parse(text)?;
            if values.insert(spec.key.clone(), value).is_some() {
                return Err(ArgError::Twice {
                    key: key.to_owned(),
                });
            }
        }
        for spec in specs {
            if values.contains_key(&spec.key) {
                continue;
            }
            match &spec.presence {
                Presence::Required => return Err(missing(spec)),
                Presence::Optional => {}
                Presence::Default(value) => {
                    values.insert(spec.key.clone(), value.clone());
                }
            }
        }
        Ok(Args { values })
    }

    /// Value of the argument `key`; `None` if it is undeclared, or omitted without a default.
    pub fn get(&self, key: &str) -> Option<&ArgValue> {
        self.values.get(key)
    }

    /// Value of the argument `key`, a whole number.
    ///
    /// # Panics
    /// If the argument has no value, or a value of another type. The driver must declare it as required or with a default.
    pub fn whole(&self, key: &str) -> i64 {
        match self.get(key) {
            Some(&ArgValue::Whole(value)) => value,
            other => undeclared(key, "whole number", other),
        }
    }

    /// Value of the argument `key`, a number in its declared unit.
    ///
    /// # Panics
    /// If the argument has no value, or a value of another type. The driver must declare it as required or with a default.
    pub fn number(&self, key: &str) -> f64 {
        match self.get(key) {
            Some(&ArgValue::Number(value)) => value,
            other => undeclared(key, "number", other),
        }
    }

    /// Value of the argument `key`: a text, a path, or one word of a list.
    ///
    /// # Panics
    /// If the argument has no value, or a value of another type. The driver must declare it as required or with a default.
    pub fn text(&self, key: &str) -> &str {
        match self.get(key) {
            Some(ArgValue::Text(value)) => value,
            other => undeclared(key, "text", other),
        }
    }

    /// Value of the argument `key`: `true` or `false`.
    ///
    /// # Panics
    /// If the argument has no value, or a value of another type. The driver must declare it as required or with a default.
    pub fn flag(&self, key: &str) -> bool {
        match self.get(key) {
            Some(&ArgValue::Flag(value)) => value,
            other => undeclared(key, "flag", other),
        }
    }
}

impl ArgSpec {
    /// True if this argument has a value in `args` that is not its default.
    pub fn is_set_by(&self, args: &Args) -> bool {
        match &self.presence {
            Presence::Default(value) => args.get(&self.key) != Some(value),
            Presence::Required | Presence::Optional => args.get(&self.key).is_some(),
        }
    }
}

/// Error for an undeclared `key`.
fn unknown(key: &str, specs: &[ArgSpec]) -> ArgError {
    let known: Vec<String> = specs.iter().map(|spec| spec.key.clone()).collect();
    ArgError::Unknown {
        key: key.to_owned(),
        nearest: nearest(key, known.iter().map(String::as_str)).map(str::to_owned),
        known,
    }
}

/// Error for a missing required argument.
fn missing(spec: &ArgSpec) -> ArgError {
    ArgError::Missing {
        key: spec.key.clone(),
        expected: spec.expected(),
        help: spec.help.clone(),
    }
}

fn undeclared(key: &str, expected: &str, found: Option<&ArgValue>) -> ! {
    panic!(
        "`{key}` is {found:?}: the driver must declare it as a {expected} that is required or has a default"
    )
}

/// Splits `text` at single semicolons, reads `;;` as one semicolon and drops blank parts.
fn parts(text: &str) -> Vec<String> {
    let mut parts = vec![String::new()];
    let mut characters = text.chars().peekable();
    while let Some(character) = characters.next() {
        if character == ';' && characters.next_if_eq(&';').is_none() {
            parts.push(String::new());
        } else if let Some(part) = parts.last_mut() {
            part.push(character);
        }
    }
    parts.retain(|part| !part.trim().is_empty());
    parts
}

impl fmt::Display for Args {
    /// Writes the canonical text: every argument with a value, defaults included, sorted by key. [`parse`](Args::parse) reads this text.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (position, (key, value)) in self.values.iter().enumerate() {
            let separator = if position == 0 { "" } else { ";" };
            let value = value.to_string().replace(';', ";;");
            write!(f, "{separator}{key}={value}")?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn specs() -> Vec<ArgSpec> {
        vec![
            ArgSpec::path("folder").help("where the frames are"),
            ArgSpec::whole("seed", 0, 99).default(ArgValue::Whole(7)),
            ArgSpec::number("rate", 0.5, 1e3).unit("Hz").optional(),
            ArgSpec::choice("pace", ["virtual", "real"])
                .default(ArgValue::Text("virtual".to_owned())),
            ArgSpec::flag("repeat").default(ArgValue::Flag(false)),
        ]
    }

    fn refused(text: &str) -> String {
        Args::parse(&specs(), text).expect_err(text).to_string()
    }

    #[test]
    fn what_was_not_given_stands_at_its_default() {
        let args = Args::parse(&specs(), "folder=a b; rate = 30Hz").expect("good");
        assert_eq!(args.text("folder"), "a b");
        assert_eq!((args.whole("seed"), args.flag("repeat")), (7, false));
        assert_eq!(args.get("rate"), Some(&ArgValue::Number(30.0)));
        let without = Args::parse(&specs(), "folder=x").expect("good");
        assert_eq!(without.get("rate"), None);
    }

    #[test]
    fn the_canonical_text_reads_back_whatever_the_order_and_the_characters() {
        let args = Args::parse(&specs(), "seed=3;folder=odd;;name=1;repeat=true").expect("good");
        assert_eq!(args.text("folder"), "odd;name=1");
        let text = args.to_string();
        assert_eq!(text, "folder=odd;;name=1;pace=virtual;repeat=true;seed=3");
        assert_eq!(Args::parse(&specs(), &text), Ok(args));
    }

    #[test]
    fn whatever_is_wrong_is_named_with_what_would_be_accepted() {
        let cases = [
            ("folder", "`folder`: expected `key=value`"),
            (
                "folder=x;sede=1",
                "`sede`: unknown argument, did you mean `seed`?",
            ),
            (
                "folder=x;zzz=1",
                "`zzz`: unknown argument, expected one of `folder`, `seed`, `rate`, `pace`, `repeat`",
            ),
            ("folder=x;seed=1;seed=1", "`seed`: given twice"),
            (
                "seed=1",
                "`folder`: missing, expected a path: where the frames are",
            ),
            (
                "folder=x;seed=100",
                "`seed`: `100`, expected a whole number from 0 to 99",
            ),
            (
                "folder=x;seed=1.5",
                "`seed`: `1.5`, expected a whole number from 0 to 99",
            ),
            (
                "folder=x;rate=NaN",
                "`rate`: `NaN`, expected a number from 0.5 to 1000 Hz",
            ),
            (
                "folder=x;rate=30 ms",
                "`rate`: `30 ms`, expected a number from 0.5 to 1000 Hz",
            ),
            ("folder=x;pace=reel", "`pace`: `reel`, did you mean `real`?"),
            (
                "folder=x;repeat=yes",
                "`repeat`: `yes`, expected `true` or `false`",
            ),
            ("folder=", "`folder`: ``, expected a path"),
        ];
        for (text, message) in cases {
            assert_eq!(refused(text), message);
        }
    }
}
