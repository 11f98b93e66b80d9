//! An import in words.

use std::fmt;

use super::copy::ImportReport;
use super::plan::ImportPlan;
use super::summary::{Conversion, ImportSummary};
use crate::quality::names_quality;
use crate::text::{shown, shown_path};

impl fmt::Display for ImportSummary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for table in &self.tables {
            writeln!(f, "read     {}", shown_path(table))?;
        }
        let left_out = self.rows_read - self.rows_kept;
        write!(
            f,
            "rows     {} read, {} kept, {left_out} left out",
            self.rows_read, self.rows_kept
        )?;
        for (position, (reason, count)) in self.dropped.iter().enumerate() {
            let separator = if position == 0 { ": " } else { ", " };
            write!(f, "{separator}{} {count}", shown(reason))?;
        }
        writeln!(f)?;
        for conversion in &self.conversions {
            writeln!(
                f,
                "channel  {conversion}, {} absent",
                self.rows_kept - conversion.present
            )?;
        }
        self.write_unmentioned(f)?;
        let Some(order) = self.channel_order else {
            return self.write_suspicions(f);
        };
        writeln!(
            f,
            "frames   {} of them, colours {}",
            self.rows_kept,
            order.name()
        )?;
        match &self.reference {
            Some(path) => writeln!(f, "without contact  {}", shown_path(path))?,
            None => writeln!(f, "without contact  unknown")?,
        }
        if self.unnamed_images > 0 {
            writeln!(f, "images that no row names: {}", self.unnamed_images)?;
            for path in &self.first_unnamed_images {
                writeln!(f, "         {}", shown_path(path))?;
            }
        }
        self.write_suspicions(f)
    }
}

impl ImportSummary {
    /// The columns that are left behind; those that rate their rows, one by one.
    fn write_unmentioned(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.unmentioned_columns.is_empty() {
            return Ok(());
        }
        let names: Vec<String> = self
            .unmentioned_columns
            .iter()
            .map(|name| shown(name))
            .collect();
        writeln!(
            f,
            "columns that the map does not mention: {}",
            names.join(", ")
        )?;
        for name in &self.unmentioned_columns {
            if names_quality(name) {
                writeln!(
                    f,
                    "warning  unmentioned-quality: `{}` may say which rows are bad, and no rule reads it; name it under [drop] or [attributes] of the map",
                    shown(name)
                )?;
            }
        }
        Ok(())
    }

    fn write_suspicions(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.suspicions
            .iter()
            .try_for_each(|suspicion| writeln!(f, "warning  {suspicion}"))
    }
}

impl fmt::Display for Conversion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} [{}] = {}`{}` [{}]: {} values",
            self.channel,
            self.to,
            if self.is_negated { "−" } else { "" },
            shown(&self.column),
            self.from.symbol(),
            self.present
        )
    }
}

impl fmt::Display for ImportPlan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self.summary(), f)
    }
}

impl fmt::Display for ImportReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(&self.summary, f)?;
        if let Some(info) = self.frames {
            writeln!(f, "verified {} frames of {info}", self.summary.rows_kept)?;
        }
        writeln!(f, "digest   {}", self.digest)?;
        writeln!(f, "written  {}", shown_path(&self.path))
    }
}
