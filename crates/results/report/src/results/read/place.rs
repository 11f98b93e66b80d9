//! A value with the way to it.

use super::super::ResultsError;
use crate::json::Json;
use taceva_core::shown;

/// A value with the way to it.
pub(super) struct Place<'a> {
    path: String,
    json: &'a Json,
}

impl<'a> Place<'a> {
    pub(super) fn root(json: &'a Json) -> Place<'a> {
        Place {
            path: String::new(),
            json,
        }
    }

    pub(super) fn json(&self) -> &'a Json {
        self.json
    }

    /// The entry called `key`, which must be there.
    pub(super) fn entry(&self, key: &str) -> Result<Place<'a>, ResultsError> {
        self.optional(key).ok_or_else(|| ResultsError::Place {
            place: self.below(key),
            expected: "a value",
            found: "nothing".to_owned(),
        })
    }

    pub(super) fn optional(&self, key: &str) -> Option<Place<'a>> {
        Some(Place {
            path: self.below(key),
            json: self.json.get(key)?,
        })
    }

    pub(super) fn entries(&self) -> Result<Vec<(&'a str, Place<'a>)>, ResultsError> {
        let entries = self
            .json
            .entries()
            .ok_or_else(|| self.refuse("an object"))?;
        let place = |(key, json): &'a (String, Json)| {
            let path = self.below(key);
            (key.as_str(), Place { path, json })
        };
        Ok(entries.iter().map(place).collect())
    }

    pub(super) fn items(&self) -> Result<Vec<Place<'a>>, ResultsError> {
        let items = self.json.list().ok_or_else(|| self.refuse("a list"))?;
        let place = |(at, json): (usize, &'a Json)| Place {
            path: format!("{}[{at}]", self.path),
            json,
        };
        Ok(items.iter().enumerate().map(place).collect())
    }

    pub(super) fn text(&self) -> Result<&'a str, ResultsError> {
        self.json.text().ok_or_else(|| self.refuse("a text"))
    }

    pub(super) fn number(&self) -> Result<f64, ResultsError> {
        self.json.number().ok_or_else(|| self.refuse("a number"))
    }

    /// A number or null.
    pub(super) fn optional_number(&self) -> Result<Option<f64>, ResultsError> {
        match self.json {
            Json::Null => Ok(None),
            _ => self.number().map(Some),
        }
    }

    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "whole, not negative and below 2^53"
    )]
    pub(super) fn count(&self) -> Result<u64, ResultsError> {
        let number = self.number()?;
        if number.fract().abs() > 0.0 || !(0.0..9.0e15).contains(&number) {
            return Err(ResultsError::Place {
                place: self.path.clone(),
                expected: "a count",
                found: number.to_string(),
            });
        }
        Ok(number as u64)
    }

    pub(super) fn refuse(&self, expected: &'static str) -> ResultsError {
        ResultsError::Place {
            place: self.path.clone(),
            expected,
            found: self.json.kind().to_owned(),
        }
    }

    /// That what is here is not what was expected, but `found`.
    pub(super) fn refuse_found(&self, expected: &'static str, found: String) -> ResultsError {
        ResultsError::Place {
            place: self.path.clone(),
            expected,
            found,
        }
    }

    fn below(&self, key: &str) -> String {
        let key = shown(key);
        if self.path.is_empty() {
            key.to_string()
        } else {
            format!("{}.{key}", self.path)
        }
    }
}
