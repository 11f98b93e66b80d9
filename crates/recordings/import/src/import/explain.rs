//! Describes an import in words, as printed by `taceva import`.

use std::fmt;

use super::copy::ImportReport;
use super::map::reference_attribute;
use super::plan::ImportPlan;
use super::summary::{Conversion, FrameSummary, ImportSummary, JoinSummary, ZeroSummary};
use taceva_core::counted;
use taceva_dataset::internal::{shown, shown_path};
use taceva_dataset::names_quality;

impl fmt::Display for ImportSummary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for table in &self.tables {
            writeln!(f, "read     {}", shown_path(table))?;
        }
        if self.files > 0 {
            writeln!(
                f,
                "read     {}, each of which is a row",
                counted(self.files, "file")
            )?;
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
        if self.points > 0 {
            writeln!(f, "points   {}", counted(self.points, "contact point"))?;
        }
        for join in &self.joins {
            writeln!(f, "{join}")?;
        }
        for conversion in &self.conversions {
            writeln!(
                f,
                "channel  {conversion}, {} absent",
                self.rows_kept - conversion.present
            )?;
        }
        for task in &self.tasks {
            writeln!(f, "task     {task}")?;
        }
        for zero in &self.zeros {
            writeln!(f, "{zero}")?;
        }
        if let Some(gravity) = &self.gravity {
            writeln!(
                f,
                "gravity  forces and torques minus the {}",
                shown(gravity)
            )?;
        }
        if let Some(info) = self.signals {
            writeln!(
                f,
                "signals  {} of {info}",
                counted(self.rows_kept, "sample")
            )?;
        }
        for (array, count) in &self.absent_chunks {
            writeln!(
                f,
                "chunks that were never written: {count} of {}; read as the fill value",
                shown(array)
            )?;
        }
        self.write_unmentioned(f)?;
        for topic in &self.unread_topics {
            writeln!(f, "not read {}", taceva_core::shown(topic))?;
        }
        for frames in &self.frames {
            self.write_frames(frames, f)?;
        }
        if self.unnamed_images > 0 || self.has_more_files {
            let more = match self.has_more_files {
                true => ", and perhaps more: the folder has more files than are searched",
                false => "",
            };
            writeln!(f, "images that no row names: {}{more}", self.unnamed_images)?;
            for path in &self.first_unnamed_images {
                writeln!(f, "         {}", shown_path(path))?;
            }
        }
        for (file, count) in &self.unused_frames {
            writeln!(f, "frames that no row uses: {count} of {}", shown(file))?;
        }
        self.write_suspicions(f)
    }
}

impl ImportSummary {
    /// Writes the lines that describe the frames of a view.
    fn write_frames(&self, frames: &FrameSummary, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let view = frames.view.iter();
        let view: String = view.map(|view| format!(" of the view {view}")).collect();
        writeln!(
            f,
            "frames   {}{view}, colours {}",
            self.rows_kept,
            frames.channel_order.name()
        )?;
        match &frames.reference {
            Some(path) => writeln!(f, "without contact  {}", shown_path(path)),
            None if frames.references > 0 => writeln!(
                f,
                "without contact  {}, named by the attribute `{}` and not copied",
                counted(frames.references, "different picture"),
                reference_attribute(frames.view.as_deref())
            ),
            None => writeln!(f, "without contact  unknown"),
        }
    }

    /// Writes the names of columns that the map does not mention. Columns with quality ratings get a separate line each.
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
                    "warning  unmentioned-quality: `{}` may mark bad rows, but no rule of the map reads it; name it under [drop] or \
                     [attributes]",
                    shown(name)
                )?;
            }
        }
        Ok(())
    }

    fn write_suspicions(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for warning in &self.warnings {
            writeln!(f, "warning  {warning}")?;
        }
        self.suspicions
            .iter()
            .try_for_each(|suspicion| writeln!(f, "warning  {suspicion}"))
    }
}

impl fmt::Display for Conversion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let sign = if self.is_negated { "−" } else { "" };
        let column = shown(&self.column);
        let cell = self.offset.map_or_else(
            || format!("`{column}`"),
            |offset| format!("(`{column}` − {offset})"),
        );
        let scale = self
            .scale
            .map_or_else(String::new, |scale| format!("{scale} · "));
        write!(
            f,
            "{} [{}] = {sign}{scale}{cell} [{}]: {}",
            self.channel,
            self.to,
            self.from.symbol(),
            counted(self.present, "value")
        )
    }
}

impl fmt::Display for ZeroSummary {
    /// Writes a line such as `zero     Fz minus -0.0210 to 1.5020 (mean of the first 10 rows of each table; 2 blocks)`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "zero     {} minus {:.4} to {:.4} ({}; {})",
            self.channel,
            self.least,
            self.greatest,
            shown(&self.rule),
            counted(self.blocks, "block")
        )
    }
}

impl fmt::Display for JoinSummary {
    /// Writes a line such as `join     ft: 23 rows matched, at most 2.5 ms away, 1 unmatched; 170 of its rows unused`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "join     {}: {} matched",
            self.name,
            counted(self.matched, "row")
        )?;
        if let Some(gap_s) = self.greatest_gap_s {
            write!(f, ", at most {:.3} ms away", gap_s * 1e3)?;
        }
        write!(
            f,
            ", {} unmatched; {} of its rows unused",
            self.unmatched, self.unused
        )?;
        if self.skipped > 0 {
            write!(f, ", {} skipped", self.skipped)?;
        }
        match &self.frame_id {
            None => Ok(()),
            Some(frame) => write!(
                f,
                ", {} in other frames than {} left out",
                self.in_other_frames,
                shown(frame)
            ),
        }
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
            writeln!(
                f,
                "verified {} of {info}",
                counted(self.summary.rows_kept, "frame")
            )?;
        }
        for view in &self.views {
            let (name, info) = (&view.name, view.frames.info);
            let frames = counted(self.summary.rows_kept, "frame");
            writeln!(f, "verified {frames} of the view {name}, {info}")?;
        }
        writeln!(f, "digest   {}", self.digest)?;
        writeln!(f, "written  {}", shown_path(&self.path))
    }
}
