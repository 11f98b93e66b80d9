//! Parser from TOML to sections. Checks that every key is known and that every value has its unit and range. Errors name the line.

use std::ops::Range;
use taceva_core::shown;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::error::{ParameterError, ParameterErrorKind};
use super::section::{Entry, Origin, Row, Section};

/// Maximum length of a table, bytes. Typical tables have a few thousand bytes.
const LENGTH_MAX: usize = 1 << 20;

/// Table that is being parsed.
pub(super) struct Document<'t> {
    text: &'t str,
    root: DeTable<'t>,
    known: Vec<&'static str>,
    entries: Vec<Entry>,
}

impl<'t> Document<'t> {
    pub(super) fn parse(text: &'t str) -> Result<Document<'t>, ParameterError> {
        if text.len() > LENGTH_MAX {
            let message = format!("{} bytes, expected at most {LENGTH_MAX}", text.len());
            return Err(ParameterError::new(
                1,
                ParameterErrorKind::Syntax { message },
            ));
        }
        let root = DeTable::parse(text).map_err(|error| {
            let line = error.span().map_or(1, |span| line_of(text, span));
            let message = error.message().to_owned();
            ParameterError::new(line, ParameterErrorKind::Syntax { message })
        })?;
        Ok(Document {
            text,
            root: root.into_inner(),
            known: vec!["name"],
            entries: Vec::new(),
        })
    }

    /// Name of the sensor.
    pub(super) fn name(&self) -> Result<String, ParameterError> {
        let expected = "the name of the sensor, a string";
        let value = self
            .root
            .get("name")
            .ok_or_else(|| self.missing("name", expected))?;
        match value.get_ref() {
            DeValue::String(name) if !name.trim().is_empty() => Ok(name.trim().to_owned()),
            other => Err(self.form(value.span(), "name", other, expected)),
        }
    }

    /// Parses a required section.
    pub(super) fn required<S: Section>(&mut self) -> Result<S, ParameterError> {
        match self.optional()? {
            Some(section) => Ok(section),
            None => Err(self.missing_section(S::NAME)),
        }
    }

    /// Parses an optional section.
    pub(super) fn optional<S: Section>(&mut self) -> Result<Option<S>, ParameterError> {
        self.known.push(S::NAME);
        let Some(value) = self.root.get(S::NAME) else {
            return Ok(None);
        };
        let DeValue::Table(table) = value.get_ref() else {
            return Err(self.form(value.span(), S::NAME, value.get_ref(), "a section"));
        };
        self.refuse_unknown(table, "key", S::NAME, S::ROWS.iter().map(|row| row.key))?;
        let mut values = Vec::with_capacity(S::ROWS.len());
        let mut entries = Vec::with_capacity(S::ROWS.len());
        for row in S::ROWS {
            let entry = self.entry(S::NAME, table, value.span(), row)?;
            values.push(entry.value);
            entries.push(entry);
        }
        self.entries.extend(entries);
        Ok(Some(S::from_values(&values)))
    }

    /// Rejects unknown sections. Returns all values, ordered by section and key.
    pub(super) fn finish(mut self) -> Result<Vec<Entry>, ParameterError> {
        self.refuse_unknown(&self.root, "section", "", self.known.iter().copied())?;
        self.entries.sort_by_key(|entry| (entry.section, entry.key));
        Ok(self.entries)
    }

    pub(super) fn missing_section(&self, section: &str) -> ParameterError {
        self.missing(section, "a section of this name")
    }

    pub(super) fn two_bodies(&self) -> ParameterError {
        let span = self.root.get("dome").map_or(0..0, Spanned::span);
        ParameterError::new(
            line_of(self.text, span),
            ParameterErrorKind::Form {
                key: "dome".to_owned(),
                found: "a second body".to_owned(),
                expected: "either `layer` or `dome`".to_owned(),
            },
        )
    }

    fn entry(
        &self,
        section: &'static str,
        table: &DeTable<'_>,
        section_span: Range<usize>,
        row: &Row,
    ) -> Result<Entry, ParameterError> {
        let name = format!("{section}.{}", row.key);
        let form = format!(
            "{{ value = {} to {}, unit = \"{}\", origin = \"{}\" }}",
            row.least,
            row.most,
            row.unit,
            Origin::ALL.map(Origin::name).join("|")
        );
        let number = table.get(row.key).ok_or_else(|| {
            let kind = ParameterErrorKind::Missing {
                key: name.clone(),
                expected: form.clone(),
            };
            ParameterError::new(line_of(self.text, section_span), kind)
        })?;
        let line = line_of(self.text, number.span());
        let DeValue::Table(parts) = number.get_ref() else {
            return Err(self.form(number.span(), &name, number.get_ref(), &form));
        };
        let known = ["value", "unit", "origin", "note"];
        self.refuse_unknown(parts, "part", &name, known.into_iter())?;
        let part = |key: &str| {
            parts.get(key).ok_or_else(|| {
                let kind = ParameterErrorKind::Missing {
                    key: format!("{name}.{key}"),
                    expected: form.clone(),
                };
                ParameterError::new(line, kind)
            })
        };
        let value = self.value(part("value")?, &name, row)?;
        let unit = part("unit")?;
        if unit.get_ref().as_str() != Some(row.unit) {
            let expected = format!("the unit \"{}\"", row.unit);
            return Err(self.form(unit.span(), &name, unit.get_ref(), &expected));
        }
        let origin = part("origin")?;
        let known = origin.get_ref().as_str().and_then(Origin::from_name);
        let origin = known.ok_or_else(|| {
            let expected = format!("one of {}", Origin::ALL.map(Origin::name).join(", "));
            self.form(origin.span(), &name, origin.get_ref(), &expected)
        })?;
        Ok(Entry {
            section,
            key: row.key,
            value,
            unit: row.unit,
            origin,
            line,
        })
    }

    fn value(
        &self,
        value: &Spanned<DeValue<'_>>,
        name: &str,
        row: &Row,
    ) -> Result<f64, ParameterError> {
        let number = match value.get_ref() {
            DeValue::Float(number) => number.as_str().parse::<f64>().ok(),
            DeValue::Integer(number) if number.radix() == 10 => number.as_str().parse().ok(),
            _ => None,
        };
        let Some(number) = number else {
            return Err(self.form(value.span(), name, value.get_ref(), "a decimal number"));
        };
        if (row.least..=row.most).contains(&number) {
            // −0 and 0 are equal parameters and have one digest.
            return Ok(number + 0.0);
        }
        let kind = ParameterErrorKind::Range {
            key: name.to_owned(),
            value: number,
            expected: format!("{} to {} {}", row.least, row.most, row.unit),
        };
        Err(ParameterError::new(line_of(self.text, value.span()), kind))
    }

    fn refuse_unknown(
        &self,
        table: &DeTable<'_>,
        what: &'static str,
        within: &str,
        known: impl Iterator<Item = &'static str> + Clone,
    ) -> Result<(), ParameterError> {
        let unknown = table
            .keys()
            .filter(|key| !known.clone().any(|known| known == key.get_ref()))
            .min_by_key(|key| key.span().start);
        let Some(unknown) = unknown else {
            return Ok(());
        };
        let nearest = taceva_core::nearest(unknown.get_ref(), known).map(str::to_owned);
        let separator = if within.is_empty() { "" } else { "." };
        let kind = ParameterErrorKind::Unknown {
            what,
            key: format!("{within}{separator}{}", shown(unknown.get_ref().as_ref())),
            nearest,
        };
        Err(ParameterError::new(
            line_of(self.text, unknown.span()),
            kind,
        ))
    }

    fn missing(&self, key: &str, expected: &str) -> ParameterError {
        let kind = ParameterErrorKind::Missing {
            key: key.to_owned(),
            expected: expected.to_owned(),
        };
        ParameterError::new(self.text.lines().count().max(1), kind)
    }

    fn form(
        &self,
        span: Range<usize>,
        key: &str,
        found: &DeValue<'_>,
        expected: &str,
    ) -> ParameterError {
        let found = match found {
            DeValue::String(text) => format!("{text:?}"),
            DeValue::Integer(number) => number.as_str().to_owned(),
            DeValue::Float(number) => number.as_str().to_owned(),
            other => format!("a value of type {}", other.type_str()),
        };
        let kind = ParameterErrorKind::Form {
            key: key.to_owned(),
            found,
            expected: expected.to_owned(),
        };
        ParameterError::new(line_of(self.text, span), kind)
    }
}

/// Line on which a span begins, from 1.
fn line_of(text: &str, span: Range<usize>) -> usize {
    let before = text.as_bytes().iter().take(span.start);
    before.filter(|byte| **byte == b'\n').count() + 1
}
