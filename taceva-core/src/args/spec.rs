//! Declaration of an argument, used for checks, help and listings.

use std::fmt;

use super::error::ArgError;
use super::kind::{ArgKind, Presence};
use super::value::ArgValue;
use crate::suggestion::nearest;
use crate::unit::SourceUnit;

/// The declaration of one argument of a driver.
///
/// ```
/// use taceva_core::{ArgSpec, ArgValue};
/// let rate = ArgSpec::number("rate", 1.0, 60.0).unit("Hz").default(ArgValue::Number(30.0)).help("frames a second");
/// assert_eq!(rate.parse("25 Hz"), Ok(ArgValue::Number(25.0)));
/// assert_eq!(rate.expected(), "a number from 1 to 60 Hz");
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ArgSpec {
    /// Key of the argument.
    pub key: String,
    /// Type and range of the value.
    pub kind: ArgKind,
    /// Unit of a number, such as `ms` or `mm/h`; `None` without a unit. Users may write the unit after the number.
    pub unit: Option<String>,
    /// Required, optional, or with a default value.
    pub presence: Presence,
    /// Help text in lists of arguments and in the message for a missing argument.
    pub help: String,
    /// True if the argument can change a property that is known before the device is opened, such as the size of its frames.
    pub changes_facts: bool,
}

impl ArgSpec {
    /// A required argument of `kind`, without a unit.
    pub fn new(key: &str, kind: ArgKind) -> ArgSpec {
        ArgSpec {
            key: key.to_owned(),
            kind,
            unit: None,
            presence: Presence::Required,
            help: String::new(),
            changes_facts: false,
        }
    }

    /// A required argument `key` whose value is a text.
    pub fn text(key: &str) -> ArgSpec {
        ArgSpec::new(key, ArgKind::Text)
    }

    /// A required argument `key` whose value is a path.
    pub fn path(key: &str) -> ArgSpec {
        ArgSpec::new(key, ArgKind::Path)
    }

    /// A required argument `key` whose value is a whole number from `least` to `most`.
    pub fn whole(key: &str, least: i64, most: i64) -> ArgSpec {
        ArgSpec::new(key, ArgKind::Whole { least, most })
    }

    /// A required argument `key` whose value is a number from `least` to `most`.
    pub fn number(key: &str, least: f64, most: f64) -> ArgSpec {
        ArgSpec::new(key, ArgKind::Number { least, most })
    }

    /// A required argument whose value is one of the words of `of`.
    pub fn choice<'a>(key: &str, of: impl IntoIterator<Item = &'a str>) -> ArgSpec {
        let of = of.into_iter().map(str::to_owned).collect();
        ArgSpec::new(key, ArgKind::Choice { of })
    }

    /// A required argument `key` whose value is `true` or `false`.
    pub fn flag(key: &str) -> ArgSpec {
        ArgSpec::new(key, ArgKind::Flag)
    }

    /// The same argument with the unit `symbol`, such as `ms`. Users may write a value with or without the unit.
    #[must_use]
    pub fn unit(mut self, symbol: &str) -> ArgSpec {
        self.unit = Some(symbol.to_owned());
        self
    }

    /// The same argument as an optional argument.
    #[must_use]
    pub fn optional(mut self) -> ArgSpec {
        self.presence = Presence::Optional;
        self
    }

    /// The same argument with the default `value`.
    #[must_use]
    pub fn default(mut self, value: ArgValue) -> ArgSpec {
        self.presence = Presence::Default(value);
        self
    }

    /// The same argument with its help text.
    #[must_use]
    pub fn help(mut self, help: &str) -> ArgSpec {
        self.help = help.to_owned();
        self
    }

    /// The same argument, marked as able to change properties that are known before the device is opened, such as the size of its frames.
    #[must_use]
    pub fn changes_facts(mut self) -> ArgSpec {
        self.changes_facts = true;
        self
    }

    /// Parses `text` as a value.
    ///
    /// # Errors
    /// [`ArgError::Value`] if the text is of another type or outside the range.
    pub fn parse(&self, text: &str) -> Result<ArgValue, ArgError> {
        let value = match &self.kind {
            ArgKind::Text | ArgKind::Path | ArgKind::Choice { .. } => {
                Some(ArgValue::Text(text.to_owned()))
            }
            ArgKind::Whole { .. } => self.bare(text).parse().ok().map(ArgValue::Whole),
            ArgKind::Number { .. } => self.bare(text).parse().ok().map(ArgValue::Number),
            ArgKind::Flag => text.parse().ok().map(ArgValue::Flag),
        };
        value
            .filter(|value| self.accepts(value))
            .ok_or_else(|| ArgError::Value {
                key: self.key.clone(),
                value: text.to_owned(),
                expected: self.expected(),
                nearest: match &self.kind {
                    ArgKind::Choice { of } => {
                        nearest(text, of.iter().map(String::as_str)).map(str::to_owned)
                    }
                    _ => None,
                },
            })
    }

    /// Removes the unit of the argument from the end of `text`, if it is there.
    fn bare<'a>(&self, text: &'a str) -> &'a str {
        self.unit
            .as_deref()
            .and_then(|unit| text.strip_suffix(unit))
            .unwrap_or(text)
            .trim_end()
    }

    /// True if `value` has the type of the argument and is within its range.
    pub fn accepts(&self, value: &ArgValue) -> bool {
        match (&self.kind, value) {
            (ArgKind::Text | ArgKind::Path, ArgValue::Text(text)) => !text.is_empty(),
            (ArgKind::Choice { of }, ArgValue::Text(text)) => of.contains(text),
            (ArgKind::Whole { least, most }, ArgValue::Whole(value)) => {
                (least..=most).contains(&value)
            }
            (ArgKind::Number { least, most }, ArgValue::Number(value)) => {
                value.is_finite() && (least..=most).contains(&value)
            }
            (ArgKind::Flag, ArgValue::Flag(_)) => true,
            _ => false,
        }
    }

    /// Accepted values, as words for the end of a message: "expected …".
    pub fn expected(&self) -> String {
        let mut words = match &self.kind {
            ArgKind::Text => "a string".to_owned(),
            ArgKind::Path => "a path".to_owned(),
            ArgKind::Whole { least, most } => {
                let least = (*least > i64::MIN).then_some(least);
                let most = (*most < i64::MAX).then_some(most);
                ranged("a whole number", least, most)
            }
            ArgKind::Number { least, most } => {
                let least = least.is_finite().then_some(least);
                let most = most.is_finite().then_some(most);
                ranged("a number", least, most)
            }
            ArgKind::Choice { of } => format!("one of `{}`", of.join("`, `")),
            ArgKind::Flag => "`true` or `false`".to_owned(),
        };
        if let Some(unit) = &self.unit {
            words.push(' ');
            words.push_str(unit);
        }
        words
    }

    /// Error in the declaration, such as a default outside the range; `None` if the declaration is valid.
    pub fn fault(&self) -> Option<String> {
        let key_is_plain = self
            .key
            .starts_with(|first: char| first.is_ascii_lowercase())
            && self
                .key
                .bytes()
                .all(|byte| byte.is_ascii_lowercase() || byte.is_ascii_digit() || byte == b'_');
        let range_is_empty = match &self.kind {
            ArgKind::Whole { least, most } => least > most,
            ArgKind::Number { least, most } => !matches!(
                least.partial_cmp(most),
                Some(std::cmp::Ordering::Less | std::cmp::Ordering::Equal)
            ),
            ArgKind::Choice { of } => of.is_empty(),
            _ => false,
        };
        let is_number = matches!(self.kind, ArgKind::Whole { .. } | ArgKind::Number { .. });
        let key = &self.key;
        if !key_is_plain {
            return Some(format!(
                "argument {key:?}: expected a lower-case letter, then letters, digits or `_`"
            ));
        }
        if range_is_empty {
            return Some(format!("argument `{key}` accepts nothing"));
        }
        match (&self.unit, &self.presence) {
            (Some(unit), _) if !is_number => Some(format!(
                "argument `{key}` is not a number, but has the unit {unit}"
            )),
            (Some(unit), _) if SourceUnit::parse(unit).is_err() => {
                Some(format!("argument `{key}` has the unknown unit `{unit}`"))
            }
            (_, Presence::Default(value)) if !self.accepts(value) => Some(format!(
                "the default of argument `{key}` is `{value}`, expected {}",
                self.expected()
            )),
            _ => None,
        }
    }
}

fn ranged(noun: &str, least: Option<impl fmt::Display>, most: Option<impl fmt::Display>) -> String {
    match (least, most) {
        (Some(least), Some(most)) => format!("{noun} from {least} to {most}"),
        (Some(least), None) => format!("{noun} of at least {least}"),
        (None, Some(most)) => format!("{noun} of at most {most}"),
        (None, None) => noun.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_declaration_that_contradicts_itself_is_found() {
        let good = ArgSpec::number("rate", 0.5, 60.0).unit("Hz");
        assert_eq!(good.fault(), None);
        let faults = [
            ArgSpec::text("Rate"),
            ArgSpec::whole("n", 2, 1),
            ArgSpec::number("x", f64::NAN, 1.0),
            ArgSpec::choice("c", []),
            ArgSpec::text("t").unit("mm"),
            ArgSpec::number("x", 0.0, 1.0).unit("furlong"),
            ArgSpec::number("x", 0.0, 1.0).default(ArgValue::Number(2.0)),
            ArgSpec::number("x", 0.0, 1.0).default(ArgValue::Flag(true)),
        ];
        for spec in faults {
            assert!(spec.fault().is_some(), "{spec:?}");
        }
    }

    #[test]
    fn an_open_range_is_said_without_its_open_end() {
        assert_eq!(
            ArgSpec::whole("seed", 0, i64::MAX).expected(),
            "a whole number of at least 0"
        );
        assert_eq!(
            ArgSpec::number("x", f64::NEG_INFINITY, f64::INFINITY).expected(),
            "a number"
        );
    }
}
