//! Checks of a scene after parsing: ranges, names and contradictions.

mod document;
mod protocol;
mod recording;
mod stress;
mod study;
mod wear;
mod widths;

use taceva_core::shown;

use taceva_metrics::{Settings, catalogue};

use super::metrics::{MetricsSpec, ReportSpec};
use super::task_metrics::{phase_of_task, task_metrics};
use super::{NamedBy, Scene};
use crate::limit_spec::LimitSpec;
use crate::text::Setting;
use crate::text::Text;
use crate::text::{SceneError, SceneProblem};
use document::WrittenScene;

/// Longest length in a scene, in mm.
const GREATEST_LENGTH: f64 = 1_000.0;

/// Parses and checks the scene `text`.
pub(super) fn checked(text: Text, named_by: NamedBy) -> Result<Scene, SceneError> {
    let written: WrittenScene = text.read()?;
    let named_by = match &written.rig {
        Some(_) => NamedBy::Rig,
        None => named_by,
    };
    let check = Check {
        text: &text,
        named_by,
    };
    check.version(&written)?;
    check.limits(&written.limits)?;
    check.metrics(&written.metrics)?;
    check.widths(&written.metrics)?;
    check.protocol(&written.protocol)?;
    check.tasks(&written.metrics, &written.protocol)?;
    check.report(&written.report)?;
    check.stress(written.stress.as_ref())?;
    check.plugin_faults(&written)?;
    let studies = check.studies(&written)?;
    let studies = check.stages(studies, written.protocol.wear.as_ref())?;
    Ok(Scene {
        name: written.name.value,
        seed: written.seed,
        rig: written.rig,
        studies,
        metrics: written.metrics,
        protocol: written.protocol,
        report: written.report,
        stress: written.stress,
        faults: written.fault,
        text,
    })
}

struct Check<'a> {
    text: &'a Text,
    named_by: NamedBy,
}

type Checked = Result<(), SceneError>;

impl Check<'_> {
    fn refuse<T>(&self, at: Option<usize>, problem: SceneProblem) -> Result<T, SceneError> {
        Err(self.text.error(at, problem))
    }

    fn contradiction<T>(&self, at: Option<usize>, problem: &str) -> Result<T, SceneError> {
        self.refuse(at, SceneProblem::Contradiction(problem.to_owned()))
    }

    fn version(&self, written: &WrittenScene) -> Checked {
        match written.scene_version.value {
            1 => self.name("a scene", &written.name),
            other => self.refuse(written.scene_version.at(), SceneProblem::Version(other)),
        }
    }

    /// True if a rig file names the devices of the scene.
    fn is_named_elsewhere(&self) -> bool {
        self.named_by == NamedBy::Rig
    }

    /// Checks that `name` is valid as a name of `what`: short, printable and usable in a file name.
    fn name(&self, what: &str, name: &Setting<String>) -> Checked {
        let is_plain = |text: &str| {
            let is_short = (1..=80).contains(&text.len());
            is_short && text.trim() == text && !text.chars().any(|c| c.is_control() || c == '/')
        };
        if is_plain(&name.value) && !name.value.starts_with('.') {
            return Ok(());
        }
        let shown = shown(&name.value);
        let problem = format!(
            "`{shown}` is not valid as a name of {what}: expected 1 to 80 bytes without `/`, control characters, a leading `.`, or spaces at the ends"
        );
        self.contradiction(name.at(), &problem)
    }

    fn limits(&self, limits: &LimitSpec) -> Checked {
        for (key, limit) in limits.named() {
            if let Some(limit) = limit {
                self.length(key, &limit)?;
            }
        }
        Ok(())
    }

    fn tightened(&self, inner: &LimitSpec, outer: &LimitSpec) -> Checked {
        for ((key, inner), (_, outer)) in inner.named().into_iter().zip(outer.named()) {
            if let (Some(inner), Some(outer)) = (inner, outer)
                && inner.value > outer.value
            {
                let problem = SceneProblem::LimitLoosened {
                    key,
                    found: inner.value,
                    who: "[limits] of the scene".to_owned(),
                    limit: outer.value,
                };
                return self.refuse(inner.at(), problem);
            }
        }
        Ok(())
    }

    fn metrics(&self, metrics: &MetricsSpec) -> Checked {
        for name in metrics.want.iter().flatten() {
            let is_known = catalogue::select([name.value.as_str()]).is_ok()
                || phase_of_task(&name.value).is_some();
            if !is_known {
                let known = catalogue::names().chain(task_metrics()).collect();
                return Err(self
                    .text
                    .unknown_name(name.at(), "metric", &name.value, known));
            }
        }
        if let Some([]) = metrics.want.as_deref() {
            return self.contradiction(
                None,
                "`want` is empty: remove it to compute all metrics that apply",
            );
        }
        let settings = &metrics.settings;
        for (key, count) in [
            ("bins", &settings.bins),
            ("n_min", &settings.n_min),
            ("smoothing", &settings.smoothing),
        ] {
            if let Some(count) = count {
                self.count(key, count, 1, u64::from(Settings::BINS_MAX))?;
            }
        }
        for (key, number) in [
            ("gate_N", &settings.gate_n),
            ("tolerance_mm", &settings.tolerance_mm),
        ] {
            if let Some(number) = number {
                self.length(key, number)?;
            }
        }
        match &settings.smoothing {
            Some(width) if width.value % 2 == 0 => {
                let problem = format!("`smoothing` is {}, expected an odd number", width.value);
                self.contradiction(width.at(), &problem)
            }
            _ => Ok(()),
        }
    }

    fn report(&self, report: &ReportSpec) -> Checked {
        for format in &report.formats {
            if !ReportSpec::FORMATS.contains(&format.value.as_str()) {
                let known = ReportSpec::FORMATS.to_vec();
                let what = "report format";
                return Err(self
                    .text
                    .unknown_name(format.at(), what, &format.value, known));
            }
        }
        if let Some(like) = &report.like
            && !ReportSpec::LIKE.contains(&like.value.as_str())
        {
            let known = ReportSpec::LIKE.to_vec();
            let what = "value of `like`";
            return Err(self.text.unknown_name(like.at(), what, &like.value, known));
        }
        let mut keep = report.keep.iter();
        match keep.find(|keep| !ReportSpec::KEEP.contains(&keep.value.as_str())) {
            None => Ok(()),
            Some(keep) => {
                let known = ReportSpec::KEEP.to_vec();
                let what = "file to keep";
                Err(self.text.unknown_name(keep.at(), what, &keep.value, known))
            }
        }
    }

    fn count(&self, key: &'static str, count: &Setting<u32>, least: u64, greatest: u64) -> Checked {
        let found = u64::from(count.value);
        if (least..=greatest).contains(&found) {
            return Ok(());
        }
        let problem = SceneProblem::Count {
            key,
            found,
            least,
            greatest,
        };
        self.refuse(count.at(), problem)
    }

    fn length(&self, key: &'static str, number: &Setting<f64>) -> Checked {
        self.range(key, number, GREATEST_LENGTH)
    }

    fn range(&self, key: &'static str, number: &Setting<f64>, greatest: f64) -> Checked {
        let found = number.value;
        // NaN is outside every range.
        if found > 0.0 && found <= greatest {
            return Ok(());
        }
        let problem = SceneProblem::Range {
            key,
            found,
            above: 0.0,
            greatest,
        };
        self.refuse(number.at(), problem)
    }
}
