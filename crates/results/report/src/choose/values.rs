//! Table of the values of all considered sensors.

use std::collections::{BTreeMap, BTreeSet};

use taceva_core::{by_count, counted, distinct};

use super::{Choice, Step};
use crate::catalogue::Sensor;
use crate::number::numeral;
use crate::scores::sign;
use crate::table::{Cell, Column, Direction, Table};

impl Choice {
    /// Values of all sensors with a requested value: one row for each sensor, one column for each requested value, ranked sensors first.
    ///
    /// ```
    /// use taceva_report::{Need, catalogue, choose};
    /// let choice = choose(&catalogue::all(), &Need::parse("accurate shear, rate >= 20 Hz")?);
    /// let best = choice.values().rows[0].plain();
    /// assert_eq!(best[..2], ["ViTacTip", "1"]);
    /// # Ok::<(), taceva_report::NeedError>(())
    /// ```
    pub fn values(&self) -> Table {
        let all = || self.ranked.iter().chain(&self.others);
        let steps = all().flat_map(|candidate| &candidate.steps);
        let properties = distinct(steps.map(|step| step.property));
        let heads = properties.iter().map(|property| {
            let direction = Direction::Is(property.better());
            Column::new(property.to_string()).direction(direction)
        });
        let first = ["sensor", "place"].map(Column::new).into_iter();
        let known = self.ranked.len() + self.others.len();
        let caption = format!(
            "Values side by side: {known} of {} {} a requested number",
            counted(self.considered(), "sensor"),
            by_count(known, "has", "have")
        );
        let mut table = Table::new(caption, first.chain(heads));
        let mut marks: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
        for candidate in all() {
            let mut cells = vec![candidate.name.clone(), self.place_of(&candidate.name)];
            for property in &properties {
                let mut steps = candidate.steps.iter();
                let step = steps.find(|step| step.property == *property);
                let mark = step.map_or("", mark);
                let reason = step.and_then(|step| step.standing.phrase());
                if let Some(reason) = reason.filter(|_| !mark.is_empty()) {
                    marks.entry(mark).or_default().insert(reason);
                }
                let mut of_bounds = candidate.steps.iter();
                let is_unmet = of_bounds.any(|step| step.property == *property && step.is_unmet);
                let unmet = if is_unmet { " (not met)" } else { "" };
                cells.push(step.map_or_else(String::new, |step| cell(step, mark) + unmet));
            }
            table.push(cells.into_iter().map(Cell::text));
        }
        for (mark, reasons) in marks {
            let reasons: Vec<&str> = reasons.into_iter().collect();
            table.note(format!("{mark}: {}.", reasons.join(", ")));
        }
        table
    }

    /// Number of considered sensors.
    pub(super) fn considered(&self) -> usize {
        let known = self.ranked.len() + self.others.len();
        known + self.other_definitions.len() + self.unknown.len()
    }

    /// Rank such as `1` or `2 (tie)`, or a word for the reason why the sensor has no rank.
    fn place_of(&self, name: &str) -> String {
        let mut ranked = self.ranked.iter().zip(self.places()).enumerate();
        let found = ranked.find(|(_, (candidate, _))| candidate.name == name);
        let is_open = self.open.iter().any(|open| open.name == name);
        let is_dropped = self.dropped.iter().any(|dropped| dropped.name == name);
        match found {
            Some((at, (_, place))) if self.is_tied(at) => format!("{place} (tie)"),
            Some((_, (_, place))) => place.to_string(),
            None if is_open => "open".to_owned(),
            None if is_dropped => "dropped".to_owned(),
            None => "not ranked".to_owned(),
        }
    }

    /// True for a sensor with known values but no rank.
    pub(super) fn sets_aside(&self, sensor: &Sensor) -> bool {
        let dropped = self.dropped.iter().chain(&self.barred);
        let dropped = dropped.chain(&self.unplaced).chain(&self.apart);
        let names = dropped.map(|dropped| &dropped.name);
        let mut names = names.chain(self.open.iter().map(|open| &open.name));
        names.any(|name| *name == sensor.name)
    }
}

/// Sign for the standing of a value; empty if it counts without remark or is unknown.
fn mark(step: &Step) -> &'static str {
    step.value.map_or("", |_| sign(step.standing))
}

/// Value with its interval: `0.0361 N† (0.034 … 0.038)`, an inexact value that decides a need, or `unknown`.
fn cell(step: &Step, mark: &str) -> String {
    let Some(value) = step.value else {
        let inexact = step.inexact.as_deref();
        return inexact.unwrap_or("unknown").to_owned();
    };
    let value = step.property.shown(value);
    match step.interval {
        Some([low, high]) => format!("{value}{mark} ({} … {})", numeral(low), numeral(high)),
        None => format!("{value}{mark}"),
    }
}
