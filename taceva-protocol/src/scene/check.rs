//! From what is written to a scene: the checks that a parser of types cannot make.

mod protocol;

use std::collections::BTreeSet;
use taceva_core::shown;

use serde::Deserialize;
use taceva_metrics::{Settings, catalogue};

use super::counts::Protocol;
use super::devices::{DeviceSpec, LightingSpec, ModelSpec, SensorSpec};
use super::error::{SceneError, SceneProblem};
use super::limits::LimitSpec;
use super::metrics::{MetricsSpec, ReportSpec};
use super::parse::Text;
use super::renamed;
use super::setting::Setting;
use super::study::Study;
use super::{NamedBy, Scene};

/// The longest length in a scene, in mm.
const GREATEST_LENGTH: f64 = 1_000.0;
/// The table of the sensor.
const SENSOR: &str = "[sensor]";

#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "a scene")]
struct WrittenScene {
    scene_version: Setting<u32>,
    name: Setting<String>,
    #[serde(default)]
    seed: u64,
    rig: Option<Setting<String>>,
    sensor: Option<Setting<SensorSpec>>,
    robot: Option<DeviceSpec>,
    force: Option<DeviceSpec>,
    lighting: Option<LightingSpec>,
    #[serde(default)]
    limits: LimitSpec,
    model: Option<Setting<ModelSpec>>,
    #[serde(default)]
    metrics: MetricsSpec,
    #[serde(default)]
    protocol: Protocol,
    #[serde(default)]
    report: ReportSpec,
    #[serde(default)]
    study: Vec<Setting<WrittenStudy>>,
}

#[derive(Clone, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a study")]
struct WrittenStudy {
    name: Setting<String>,
    sensor: Option<Setting<SensorSpec>>,
    robot: Option<DeviceSpec>,
    force: Option<DeviceSpec>,
    lighting: Option<LightingSpec>,
    #[serde(default)]
    limits: LimitSpec,
    model: Option<Setting<ModelSpec>>,
}

/// The scene that `text` says, checked.
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
    check.protocol(&written.protocol)?;
    check.report(&written.report)?;
    let studies = check.studies(&written)?;
    Ok(Scene {
        name: written.name.value,
        seed: written.seed,
        rig: written.rig,
        studies,
        metrics: written.metrics,
        protocol: written.protocol,
        report: written.report,
        notes: renamed::notes(&text),
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

    /// A name that can be printed, and become part of a file's name.
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
            "`{shown}` is no name of {what}: expected 1 to 80 bytes without `/`, control characters, a leading `.` or space around"
        );
        self.contradiction(name.at(), &problem)
    }

    fn studies(&self, written: &WrittenScene) -> Result<Vec<Study>, SceneError> {
        if written.study.is_empty() {
            let alone = WrittenStudy {
                name: written.name.clone(),
                sensor: None,
                robot: None,
                force: None,
                lighting: None,
                limits: LimitSpec::default(),
                model: None,
            };
            return Ok(vec![self.study(written, &alone)?]);
        }
        let mut names = BTreeSet::new();
        let mut studies = Vec::new();
        for study in &written.study {
            self.name("a study", &study.value.name)?;
            if !names.insert(study.value.name.value.as_str()) {
                let problem = SceneProblem::Twice {
                    what: "studies",
                    name: study.value.name.value.clone(),
                };
                return self.refuse(study.value.name.at(), problem);
            }
            studies.push(self.study(written, &study.value)?);
        }
        Ok(studies)
    }

    /// A study with the tables of the scene where it has none of its own.
    fn study(&self, scene: &WrittenScene, study: &WrittenStudy) -> Result<Study, SceneError> {
        let Some(sensor) = study.sensor.as_ref().or(scene.sensor.as_ref()) else {
            let problem = format!(
                "`{}` has no sensor: expected [sensor] with `driver` or `dataset`",
                study.name.value
            );
            return self.refuse(study.name.at(), SceneProblem::Incomplete(problem));
        };
        self.sensor(sensor)?;
        if scene.rig.is_some() {
            let devices = [&study.robot, &study.force, &scene.robot, &scene.force];
            self.no_device(sensor.value.driver.as_ref(), devices)?;
        }
        self.limits(&study.limits)?;
        self.tightened(&study.limits, &scene.limits)?;
        let lighting = study.lighting.as_ref().or(scene.lighting.as_ref());
        let scenes = lighting.and_then(|lighting| lighting.scenes.as_ref());
        self.distinct("scenes of light", scenes)?;
        if lighting.is_some_and(|lighting| lighting.driver.is_none()) && scenes.is_none() {
            let problem = format!(
                "`{}` has a light that nobody knows: expected [lighting] with `driver`, or with `scenes` that are set by hand",
                study.name.value
            );
            return self.refuse(study.name.at(), SceneProblem::Incomplete(problem));
        }
        let model = study.model.as_ref().or(scene.model.as_ref());
        if let Some(model) = model {
            self.one_of(
                model.at(),
                "[model]",
                ("name", &model.value.name),
                ("file", &model.value.file),
            )?;
        }
        Ok(Study {
            name: study.name.value.clone(),
            sensor: sensor.value.clone(),
            robot: study.robot.as_ref().or(scene.robot.as_ref()).cloned(),
            force: study.force.as_ref().or(scene.force.as_ref()).cloned(),
            lighting: lighting.cloned(),
            limits: study.limits.or(scene.limits),
            model: model.map(|model| model.value.clone()),
            rig: None,
        })
    }

    fn sensor(&self, sensor: &Setting<SensorSpec>) -> Checked {
        let SensorSpec {
            driver,
            dataset,
            units,
            footprint,
            ..
        } = &sensor.value;
        self.one_of(
            sensor.at(),
            SENSOR,
            ("driver", driver),
            ("dataset", dataset),
        )?;
        self.distinct("units", units.as_ref())?;
        match footprint {
            Some(written) => written
                .value
                .footprint(None)
                .map(drop)
                .or_else(|problem| self.contradiction(written.at(), &problem)),
            None => Ok(()),
        }
    }

    fn one_of<T>(
        &self,
        at: Option<usize>,
        table: &str,
        (first, one): (&str, &Option<Setting<T>>),
        (second, other): (&str, &Option<Setting<T>>),
    ) -> Checked {
        match (one, other) {
            (Some(_), Some(other)) => {
                let problem = format!("{table} has `{first}` and `{second}`: expected one of them");
                self.contradiction(other.at(), &problem)
            }
            (None, None) if table == SENSOR && self.named_by == NamedBy::Rig => Ok(()),
            (None, None) => {
                let problem = format!("{table} has neither `{first}` nor `{second}`");
                self.refuse(at, SceneProblem::Incomplete(problem))
            }
            _ => Ok(()),
        }
    }

    /// Refuses devices beside a rig file, which says which there are.
    fn no_device(
        &self,
        sensor: Option<&Setting<String>>,
        devices: [&Option<DeviceSpec>; 4],
    ) -> Checked {
        let named = devices.into_iter().flatten().map(|device| &device.driver);
        match sensor.into_iter().chain(named).next() {
            None => Ok(()),
            Some(driver) => self.contradiction(
                driver.at(),
                "the scene has `rig` and `driver`: expected one of them, the rig file names the devices",
            ),
        }
    }

    /// A list of names, none empty, none twice.
    fn distinct(&self, what: &'static str, names: Option<&Setting<Vec<String>>>) -> Checked {
        let Some(names) = names else { return Ok(()) };
        let mut seen = BTreeSet::new();
        for name in &names.value {
            self.name(what, &names.clone().map(|_| name.clone()))?;
            if !seen.insert(name) {
                let name = name.clone();
                return self.refuse(names.at(), SceneProblem::Twice { what, name });
            }
        }
        if names.value.is_empty() {
            let problem = format!("the list of {what} is empty");
            return self.contradiction(names.at(), &problem);
        }
        Ok(())
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
            if catalogue::select([name.value.as_str()]).is_err() {
                let known = catalogue::names().collect();
                return Err(self
                    .text
                    .unknown_name(name.at(), "metric", &name.value, known));
            }
        }
        if let Some([]) = metrics.want.as_deref() {
            return self.contradiction(
                None,
                "`want` is empty: leave it out for all metrics that apply",
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
        Ok(())
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
        // NaN is in no range.
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
