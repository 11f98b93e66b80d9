//! Checks of a map that its types cannot express. Each problem states its line.

use std::path::Path;

use serde::Deserialize;
use taceva_core::SourceUnit;
use toml::Spanned;

use taceva_dataset::DatasetError;
use taceva_dataset::internal::{check_relative, line_of, toml_error};

/// Path and text of a map, so that errors can state the line.
pub(super) struct Check<'a> {
    pub(super) path: &'a Path,
    pub(super) text: &'a str,
}

impl Check<'_> {
    pub(super) fn at(&self, offset: usize, problem: &str) -> DatasetError {
        let line = line_of(self.text.as_bytes(), offset);
        toml_error(self.path, Some(line), problem)
    }

    pub(super) fn relative(&self, written: &str, offset: usize) -> Result<(), DatasetError> {
        check_relative(written)
            .map_err(|problem| self.at(offset, &format!("`{written}`: {problem}")))
    }

    pub(super) fn unit(&self, unit: &Spanned<String>) -> Result<SourceUnit, DatasetError> {
        if unit.get_ref() == "?" {
            return Err(self.at(
                unit.span().start,
                "`?` is a unit that a draft leaves open: write the unit of the numbers, such as \"N\", \"mN\", \"gf\" or \"mm\"",
            ));
        }
        SourceUnit::parse(unit.get_ref())
            .map_err(|error| self.at(unit.span().start, &error.to_string()))
    }
}

/// Name of a column, or its position in a table without header.
#[derive(Clone, Debug, Deserialize)]
#[serde(untagged, expecting = "the name of a column, or its position from 0")]
pub(super) enum ColumnName {
    Name(String),
    Position(u32),
}

impl ColumnName {
    pub(super) fn into_name(self) -> String {
        match self {
            ColumnName::Name(name) => name,
            ColumnName::Position(position) => position.to_string(),
        }
    }
}
