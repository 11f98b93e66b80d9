//! Argument declared in a manifest.

use serde::Deserialize;
use taceva_core::{ArgKind, ArgSpec, ArgValue, Presence};
use toml::{Spanned, Value};

use super::Refused;

/// One table `[[provides.args]]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct WrittenArgument {
    key: Spanned<String>,
    r#type: Spanned<Type>,
    unit: Option<String>,
    range: Option<Spanned<[Value; 2]>>,
    choices: Option<Spanned<Vec<String>>>,
    default: Option<Spanned<Value>>,
    #[serde(default)]
    optional: bool,
    #[serde(default)]
    help: String,
    #[serde(default)]
    changes_facts: bool,
}

#[derive(Clone, Copy, Deserialize, PartialEq)]
#[serde(rename_all = "lowercase")]
enum Type {
    Text,
    Path,
    Whole,
    Number,
    Choice,
    Flag,
}

impl WrittenArgument {
    /// Converts the declaration. Fails if its keys contradict each other.
    pub(super) fn spec(self) -> Result<ArgSpec, Refused> {
        let key = self.key.get_ref().as_str();
        let of_type = *self.r#type.get_ref();
        if let Some(range) = self.range.as_ref().filter(|_| !of_type.has_range()) {
            let problem = format!("`range`: argument `{key}` is not a number");
            return Err(Refused::at(range, problem));
        }
        let kind = match (of_type, &self.choices) {
            (Type::Choice, Some(choices)) => ArgKind::Choice {
                of: choices.get_ref().clone(),
            },
            (Type::Choice, None) => {
                let problem = format!("argument `{key}` is a choice, expected `choices = [...]`");
                return Err(Refused::at(&self.r#type, problem));
            }
            (_, Some(choices)) => {
                let problem = format!("`choices`: argument `{key}` is not a choice");
                return Err(Refused::at(choices, problem));
            }
            (Type::Text, None) => ArgKind::Text,
            (Type::Path, None) => ArgKind::Path,
            (Type::Flag, None) => ArgKind::Flag,
            (Type::Whole, None) => whole(self.range.as_ref())?,
            (Type::Number, None) => number(self.range.as_ref())?,
        };
        let presence = match (&self.default, self.optional) {
            (None, false) => Presence::Required,
            (None, true) => Presence::Optional,
            (Some(default), false) => Presence::Default(value(of_type, default)?),
            (Some(default), true) => {
                let problem = format!(
                    "argument `{key}` has a default and is `optional`: give only one of them"
                );
                return Err(Refused::at(default, problem));
            }
        };
        let mut spec = ArgSpec::new(key, kind);
        spec.unit = self.unit;
        spec.presence = presence;
        spec.help = self.help;
        spec.changes_facts = self.changes_facts;
        match spec.fault() {
            Some(fault) => Err(Refused::at(&self.key, fault)),
            None => Ok(spec),
        }
    }
}

impl Type {
    fn has_range(self) -> bool {
        matches!(self, Type::Whole | Type::Number)
    }
}

fn whole(range: Option<&Spanned<[Value; 2]>>) -> Result<ArgKind, Refused> {
    let Some(range) = range else {
        return Ok(ArgKind::Whole {
            least: i64::MIN,
            most: i64::MAX,
        });
    };
    match range.get_ref() {
        [Value::Integer(least), Value::Integer(most)] => Ok(ArgKind::Whole {
            least: *least,
            most: *most,
        }),
        _ => Err(Refused::at(range, "`range`: expected two whole numbers")),
    }
}

fn number(range: Option<&Spanned<[Value; 2]>>) -> Result<ArgKind, Refused> {
    let Some(range) = range else {
        return Ok(ArgKind::Number {
            least: f64::NEG_INFINITY,
            most: f64::INFINITY,
        });
    };
    match range.get_ref().each_ref().map(float) {
        [Some(least), Some(most)] => Ok(ArgKind::Number { least, most }),
        _ => Err(Refused::at(range, "`range`: expected two numbers")),
    }
}

fn float(value: &Value) -> Option<f64> {
    match value {
        Value::Float(value) => Some(*value),
        Value::Integer(value) => Some(*value as f64),
        _ => None,
    }
}

fn value(of_type: Type, written: &Spanned<Value>) -> Result<ArgValue, Refused> {
    let value = written.get_ref();
    let read = match (of_type, value) {
        (Type::Text | Type::Path | Type::Choice, Value::String(text)) => {
            Some(ArgValue::Text(text.clone()))
        }
        (Type::Whole, Value::Integer(value)) => Some(ArgValue::Whole(*value)),
        (Type::Number, value) => float(value).map(ArgValue::Number),
        (Type::Flag, Value::Boolean(value)) => Some(ArgValue::Flag(*value)),
        _ => None,
    };
    read.ok_or_else(|| {
        let expected = match of_type {
            Type::Text | Type::Path | Type::Choice => "a string",
            Type::Whole => "a whole number",
            Type::Number => "a number",
            Type::Flag => "true or false",
        };
        let problem = format!("`default`: found {}, expected {expected}", value.type_str());
        Refused::at(written, problem)
    })
}
