//! Caption of the main table: a sentence with number and origin of the scored samples.

use std::collections::BTreeSet;

use taceva_core::{by_count, counted};

use super::{ScoreCell, ScoreTable};
use crate::results::Study;
use taceva_results::OPTIMISTIC;

/// Facts on a study that a caption uses.
#[derive(Clone, Debug, Default)]
pub(super) struct About {
    sensor: String,
    model: Option<String>,
    part: Option<String>,
    recordings: usize,
    /// Warnings that the scores are optimistic.
    pub(super) optimistic: Vec<String>,
    /// Cross-validation as text, if each sample was held out once.
    folds: Option<String>,
    /// Groups that the split does not divide.
    group: Option<String>,
}

impl About {
    pub(super) fn of(study: &Study) -> About {
        About {
            sensor: study.sensor.clone(),
            model: study.made.model.clone(),
            part: study.made.part.clone().or_else(|| {
                let mut parts = study.made.samples.iter();
                let is_divided = parts.any(|(part, _)| part == "test");
                is_divided.then(|| "test".to_owned())
            }),
            recordings: study.made.recordings,
            folds: study.made.folds.clone(),
            group: study.made.group.clone(),
            optimistic: study
                .notes
                .iter()
                .filter(|note| note.contains(OPTIMISTIC))
                .cloned()
                .collect(),
        }
    }
}

impl ScoreTable {
    /// Caption of the main table: `Accuracy of GelSight (ridge) on 80 simulated test samples in 20 clusters by contact point, with 95 % intervals.`
    pub fn caption(&self) -> String {
        let main = self.main();
        let what = match main.is_of_accuracy() {
            true => "Accuracy",
            false => "Scores",
        };
        main.captioned(what)
    }

    /// Caption of all rows: `Scores of GelSight (ridge) on 80 simulated test samples in 20 clusters by contact point, with 95 % intervals.` A second
    /// sentence has the range of numbers of samples, if they differ.
    pub fn title(&self) -> String {
        let caption = self.captioned("Scores");
        let counts: BTreeSet<u64> = self.valued().map(|cell| cell.n).collect();
        match (counts.first(), counts.last()) {
            (Some(least), Some(greatest)) if least < greatest => {
                let points = self.points();
                format!("{caption} n is {least} to {greatest}{points}.")
            }
            _ => caption,
        }
    }

    /// Caption that begins with `what`: `Values of 2 sensors, as published, without intervals.`
    pub(super) fn captioned(&self, what: &str) -> String {
        let (samples, intervals) = (self.samples(), self.intervals());
        format!("{what} of {}{samples}{intervals}.", self.subjects())
    }

    /// Sensors and models of the caption: `GelSight (ridge)`, `4 sensors`, `3 models of GelSight`.
    fn subjects(&self) -> String {
        let sensors: BTreeSet<&str> = self.about.iter().map(|of| of.sensor.as_str()).collect();
        match (self.about.as_slice(), sensors.len()) {
            ([one], _) => {
                let name = match one.sensor.as_str() {
                    "unknown" => "predictions",
                    _ => self.names.first().map_or("", String::as_str),
                };
                let model = one.model.as_ref();
                model.map_or_else(|| name.to_owned(), |model| format!("{name} ({model})"))
            }
            (several, 1) => {
                let sensor = several.first().map_or("", |of| of.sensor.as_str());
                let of = match sensor {
                    "unknown" => String::new(),
                    sensor => format!(" of {sensor}"),
                };
                format!("{}{of}", counted(several.len(), self.noun))
            }
            (several, _) => counted(several.len(), self.noun),
        }
    }

    /// Samples of the caption: ` on 20 simulated test samples of 3 recordings`. Published numbers give `, as published`, because they rarely state
    /// the number of samples.
    fn samples(&self) -> String {
        let sources: BTreeSet<&str> = self.sources.iter().map(String::as_str).collect();
        if sources.iter().all(|source| *source == "published") {
            return ", as published".to_owned();
        }
        if sources.contains("published") {
            let drawn = ["simulated", "synthetic"];
            let drawn = drawn.into_iter().filter(|of| sources.contains(of));
            let drawn: String = drawn.map(|of| format!(", some {of}")).collect();
            return format!(", some as published{drawn}");
        }
        let of = |source: &&str| matches!(*source, "simulated" | "synthetic" | "recorded");
        let is_plain = sources.iter().all(|source| *source == "recorded");
        let sources: Vec<&str> = sources.into_iter().filter(of).collect();
        let source = match is_plain || sources.is_empty() {
            true => String::new(),
            false => format!("{} ", sources.join(" and ")),
        };
        let parts: BTreeSet<Option<&str>> =
            self.about.iter().map(|of| of.part.as_deref()).collect();
        let folds: BTreeSet<Option<&str>> =
            self.about.iter().map(|of| of.folds.as_deref()).collect();
        let has_folds = folds.iter().any(Option::is_some);
        let held_out = match folds.first() {
            Some(Some(words)) if folds.len() == 1 => format!(", each held out once ({words})"),
            _ => String::new(),
        };
        let part = match parts.first() {
            _ if has_folds => "",
            Some(Some("test")) if parts.len() == 1 => "test ",
            Some(Some("validation")) if parts.len() == 1 => "validation ",
            Some(Some("train")) if parts.len() == 1 => "training ",
            _ => "",
        };
        let n = self.common_n();
        let many = n.map_or_else(String::new, |n| format!("{n} "));
        let noun = by_count(n.unwrap_or_default(), "sample", "samples");
        let each = match self.names.len() > 1 && !many.is_empty() {
            true => " each",
            false => "",
        };
        let recordings = match self.about.as_slice() {
            [one] if one.recordings > 1 => format!(" of {} recordings", one.recordings),
            _ => String::new(),
        };
        let groups = self.groups();
        let points = match groups.is_empty() && n.is_some() {
            true => self.points(),
            false => String::new(),
        };
        format!(" on {many}{source}{part}{noun}{each}{groups}{recordings}{points}{held_out}")
    }

    /// Groups of the caption: ` of 5 groups by object`. Empty unless all intervals are computed by the same number of groups of one split.
    fn groups(&self) -> String {
        let groups: BTreeSet<Option<&str>> =
            self.about.iter().map(|of| of.group.as_deref()).collect();
        let counts: BTreeSet<Option<usize>> = self.valued().map(|cell| cell.groups).collect();
        let one = |count: usize| match groups.first() {
            Some(Some("block of time")) => format!("{count} blocks of time"),
            Some(Some(group)) => format!("{} by {group}", counted(count, "group")),
            _ => String::new(),
        };
        match (groups.len(), counts.len(), counts.first()) {
            (1, 1, Some(Some(count))) if groups.first() != Some(&None) => {
                format!(" of {}", one(*count))
            }
            _ => String::new(),
        }
    }

    /// Clusters of the caption: ` in 20 clusters by contact point`. Empty unless all intervals are computed by contact point, in the same number of
    /// clusters.
    fn points(&self) -> String {
        let with_interval = self.valued().filter(|cell| cell.ends.is_some());
        let counts: BTreeSet<Option<usize>> = with_interval.map(|cell| cell.points).collect();
        match (counts.len(), counts.first()) {
            (1, Some(Some(count))) => {
                format!(" in {} by contact point", counted(*count, "cluster"))
            }
            _ => String::new(),
        }
    }

    /// Number of samples behind every value; `None` if numbers differ or are unknown.
    pub(super) fn common_n(&self) -> Option<u64> {
        let counts: BTreeSet<u64> = self.valued().map(|cell| cell.n).collect();
        let count = counts.first().copied().filter(|_| counts.len() == 1);
        count.filter(|n| *n > 0)
    }

    /// Intervals of the caption: `, with 95 % intervals`, or the reason why there are no intervals.
    fn intervals(&self) -> String {
        if self.valued().any(|cell| cell.ends.is_some()) {
            return ", with 95 % intervals".to_owned();
        }
        let reasons: BTreeSet<Option<&str>> = self
            .valued()
            .map(|cell| cell.formatted.reason.as_deref()?.strip_prefix("none: "))
            .collect();
        let is_published = self.sources.iter().all(|source| source == "published");
        match reasons.first() {
            Some(Some(reason)) if reasons.len() == 1 && !is_published => {
                format!(", without intervals ({reason})")
            }
            _ => ", without intervals".to_owned(),
        }
    }

    /// All cells with a value.
    pub(super) fn valued(&self) -> impl Iterator<Item = &ScoreCell> {
        let cells = self.rows.iter().flat_map(|row| row.cells.iter().flatten());
        cells.filter(|cell| cell.value.is_some())
    }
}
