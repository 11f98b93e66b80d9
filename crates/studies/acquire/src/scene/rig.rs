//! Devices of a study: their arguments, and their descriptors before anything is opened.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use taceva_core::{
    ArgKind, ArgSpec, Descriptor, Device, DriverKind, DriverSource, EnablingSwitch, Registry,
};
use taceva_drivers::{Drivers, Selector};
use taceva_protocol::{
    PlannedWear, RigFile, RigInfo, Scene, SceneError, SceneProblem, Setting, Study,
};

/// Byte offset in the scene, if known, and the problem at this offset.
pub(crate) type Refused = (Option<usize>, SceneProblem);

/// Devices of a study, given by their selectors.
#[derive(Clone, Debug)]
pub(crate) struct RigSpec {
    pub(crate) sensor: Option<Setting<String>>,
    pub(crate) robot: Option<Setting<String>>,
    pub(crate) force: Option<Setting<String>>,
    pub(crate) lighting: Option<Setting<String>>,
    /// True if the run also opens the changers.
    pub(crate) changes: bool,
    /// Load of the gel before the first measured press, kN: the sum of the forces of all earlier presses. `None` without `[protocol.wear]`.
    load_kn: Option<f64>,
    seed: u64,
    /// Base folder of relative paths.
    folder: PathBuf,
}

impl RigSpec {
    /// Returns the robot and the transducer without the sensor and the lighting.
    pub(crate) fn without_sensor(&self) -> RigSpec {
        RigSpec {
            sensor: None,
            lighting: None,
            changes: false,
            ..self.clone()
        }
    }

    pub(crate) fn new(study: &Study, seed: u64, folder: &Path) -> RigSpec {
        let driver = |device: &Option<taceva_protocol::DeviceSpec>| {
            device.as_ref().map(|device| device.driver.clone())
        };
        let lighting = study.lighting.as_ref();
        RigSpec {
            sensor: study.sensor.driver.clone(),
            robot: driver(&study.robot),
            force: driver(&study.force),
            lighting: lighting.and_then(|lighting| lighting.driver.clone()),
            changes: true,
            load_kn: None,
            seed,
            folder: folder.to_owned(),
        }
    }

    /// Devices of a rig file without a scene. Relative paths refer to `folder`.
    pub(crate) fn of_file(rig: &RigFile, folder: &Path) -> RigSpec {
        let sensor = rig.sensor.as_ref();
        let robot = rig.robot.as_ref();
        let force = rig.force.as_ref();
        RigSpec {
            sensor: sensor.map(|sensor| sensor.driver.clone()),
            robot: robot.map(|robot| robot.driver.clone()),
            force: force.map(|force| force.driver.clone()),
            lighting: None,
            changes: false,
            load_kn: None,
            seed: 0,
            folder: folder.to_owned(),
        }
    }

    /// Returns the same devices with a gel that has carried the loads of `wear`. Each earlier press counts as the force of one load cycle.
    pub(crate) fn after(self, wear: Option<&PlannedWear>) -> RigSpec {
        let load_kn = wear.map(|wear| f64::from(wear.presses_since_gel) * wear.force_n / 1000.0);
        RigSpec { load_kn, ..self }
    }

    /// The same devices with a simulated gel that has `fault` at `severity`.
    pub(crate) fn worn(&self, fault: &str, severity: u8) -> RigSpec {
        let worn = |selector: String| {
            let separator = if selector.contains(':') { ';' } else { ':' };
            format!("{selector}{separator}fault={fault};severity={severity}")
        };
        RigSpec {
            sensor: self.sensor.clone().map(|sensor| sensor.map(worn)),
            ..self.clone()
        }
    }

    /// Descriptors of the devices of `study`.
    pub(crate) fn info(&self, study: &Study, drivers: &Drivers) -> Result<RigInfo, Refused> {
        let units = study.units();
        if let (Some(sensor), [first, .., last]) = (&self.sensor, units.as_slice()) {
            let ways = [first, last].map(|unit| self.selector(&drivers.sensors, sensor, unit));
            let [Ok(one), Ok(other)] = ways else {
                return Err(not_a_selector(sensor));
            };
            if one == other {
                let problem = format!(
                    "`{}` takes no argument `unit`: units `{first}` and `{last}` would be the same device",
                    sensor.value
                );
                return Err((sensor.at(), SceneProblem::Contradiction(problem)));
            }
        }
        let (first, others) = units.split_first().expect("a study has a unit");
        for unit in others {
            self.describe(&drivers.sensors, self.sensor.as_ref(), unit)?;
        }
        Ok(RigInfo {
            sensor: self.describe(&drivers.sensors, self.sensor.as_ref(), first)?,
            robot: self.describe(&drivers.robots, self.robot.as_ref(), first)?,
            force: self.describe(&drivers.forces, self.force.as_ref(), first)?,
            lighting: self.describe(&drivers.lightings, self.lighting.as_ref(), first)?,
        })
    }

    /// Selector of `device` for `unit`: the written selector, with seed and unit added if the driver accepts them and the scene does not set them.
    /// A simulated gel that ages also gets the load of earlier presses.
    pub(crate) fn selector<D: Device + ?Sized>(
        &self,
        registry: &Registry<D>,
        device: &Setting<String>,
        unit: &str,
    ) -> Result<Selector, Refused> {
        let written: Selector = device.value.parse().map_err(|_| not_a_selector(device))?;
        let refused = |error: String| (device.at(), SceneProblem::Contradiction(error));
        let factory = registry
            .get(written.driver())
            .map_err(|error| refused(error.to_string()))?;
        let taken = factory.descriptor().arguments();
        let mut arguments = self.located(written.arguments(), taken);
        let is_given = |arguments: &str, key: &str| {
            let mut given = arguments.split(';').filter_map(|part| part.split_once('='));
            given.any(|(name, _)| name.trim() == key)
        };
        let load_kn = self.load_kn.filter(|_| is_given(&arguments, "ages"));
        let added = [
            ("seed", Some(self.seed.to_string())),
            ("unit", Some(unit.to_owned())),
            ("load_kn", load_kn.map(|load| load.to_string())),
        ];
        for (key, value) in added {
            let takes = taken.iter().any(|argument| argument.key == key);
            if let Some(value) = value
                && takes
                && !is_given(&arguments, key)
            {
                let separator = if arguments.is_empty() { "" } else { ";" };
                arguments = format!("{arguments}{separator}{key}={value}");
            }
        }
        let whole = format!("{}:{arguments}", written.driver());
        whole.parse().map_err(|_| not_a_selector(device))
    }

    /// Joins relative paths in `arguments` to the folder of the scene.
    fn located(&self, arguments: &str, taken: &[ArgSpec]) -> String {
        let is_path = |key: &str| {
            let mut paths = taken.iter().filter(|taken| taken.kind == ArgKind::Path);
            paths.any(|path| path.key == key.trim())
        };
        let located = arguments.split(';').map(|part| match part.split_once('=') {
            Some((key, value)) if is_path(key) => {
                let folder = self.folder.display().to_string().replace(';', ";;");
                let path = Path::new(&folder).join(value.trim());
                format!("{key}={}", path.display())
            }
            _ => part.to_owned(),
        });
        located.collect::<Vec<_>>().join(";")
    }

    /// Names of the items in the changer `device`; `None` without a changer.
    pub(crate) fn held_by(
        &self,
        drivers: &Drivers,
        device: Option<&Setting<String>>,
    ) -> Result<Option<Vec<String>>, Refused> {
        let described = self.describe(&drivers.changers, device, "1")?;
        Ok(described.and_then(|described| Some(described.changer()?.holds.clone())))
    }

    /// Descriptor of `device` for its arguments; `None` without a `device`. Opens no device.
    pub(crate) fn describe<D: Device + ?Sized>(
        &self,
        registry: &Registry<D>,
        device: Option<&Setting<String>>,
        unit: &str,
    ) -> Result<Option<Descriptor>, Refused> {
        let Some(device) = device else {
            return Ok(None);
        };
        let refused = |error: String| {
            let problem = format!("`{}`: {error}", device.value);
            (device.at(), SceneProblem::Contradiction(problem))
        };
        let selector = self.selector(registry, device, unit)?;
        let factory = registry
            .get(selector.driver())
            .map_err(|error| refused(error.to_string()))?;
        let args = factory
            .descriptor()
            .args(selector.arguments())
            .map_err(|error| refused(error.to_string()))?;
        let described = factory.describe(&args);
        described
            .map(Some)
            .map_err(|error| refused(error.to_string()))
    }
}

/// Rejects unknown drivers, with the line and the most similar known driver.
pub(crate) fn check_drivers(scene: &Scene, drivers: &Drivers) -> Result<(), SceneError> {
    let known: Vec<(DriverKind, &str)> = keys(&drivers.sensors)
        .chain(keys(&drivers.robots))
        .chain(keys(&drivers.forces))
        .chain(keys(&drivers.lightings))
        .chain(keys(&drivers.changers))
        .collect();
    scene.check_drivers(&known)
}

/// Rejects an `enable` that does not name an enabling switch, with the line of the rig file. Rejects a switch that is named as another device. Also rejects a
/// simulated robot, because a switch cannot be held in simulated time. Opens no device.
pub(crate) fn check_switch(rig: &RigFile, drivers: &Drivers) -> Result<(), SceneError> {
    check_places(rig, drivers)?;
    let Some(operator) = &rig.operator else {
        return Ok(());
    };
    let enable = &operator.enable;
    let refused = |(at, problem)| rig.error(at, problem);
    let selector: Selector = enable
        .value
        .parse()
        .map_err(|_| refused(not_a_selector(enable)))?;
    drivers.switches.check(&selector).map_err(|error| {
        let problem = format!("`enable`: {error}");
        refused((enable.at(), SceneProblem::Contradiction(problem)))
    })?;
    if is_simulated_here(rig, drivers) {
        let problem = "`enable`: the robot is simulated, and no switch can be held in simulated time: remove [operator]";
        let problem = SceneProblem::Contradiction(problem.to_owned());
        return Err(refused((enable.at(), problem)));
    }
    Ok(())
}

/// Rejects an enabling switch that is named as the robot, the force transducer or the sensor of `rig`.
fn check_places(rig: &RigFile, drivers: &Drivers) -> Result<(), SceneError> {
    let robot = rig.robot.as_ref().map(|robot| &robot.driver);
    let force = rig.force.as_ref().map(|force| &force.driver);
    let sensor = rig.sensor.as_ref().map(|sensor| &sensor.driver);
    for device in [robot, force, sensor].into_iter().flatten() {
        let selector: Result<Selector, _> = device.value.parse();
        if let Ok(selector) = selector
            && drivers.switches.has(selector.driver())
        {
            let problem = format!(
                "`{}` is an enabling switch and measures nothing: write it as `enable` under [operator]",
                selector.driver()
            );
            return Err(rig.error(device.at(), SceneProblem::Contradiction(problem)));
        }
    }
    Ok(())
}

/// Rejects an invalid or empty changer of `rig`, with the line of the rig file. Rejects every changer if the robot is simulated, because the
/// simulated bench changes specimens and units itself. Opens no device.
pub(crate) fn check_changers(rig: &RigFile, drivers: &Drivers) -> Result<(), SceneError> {
    let folder = Path::new(rig.name()).parent().unwrap_or(Path::new(""));
    let spec = RigSpec::of_file(rig, folder);
    let changers = [
        ("specimen", &rig.changers.specimen),
        ("unit", &rig.changers.unit),
    ];
    for (key, changer) in changers {
        let Some(changer) = changer else {
            continue;
        };
        let refused = |(at, problem)| rig.error(at, problem);
        let contradiction =
            |problem: String| refused((changer.at(), SceneProblem::Contradiction(problem)));
        let holds = spec.held_by(drivers, Some(changer)).map_err(refused)?;
        if holds.is_none_or(|holds| holds.is_empty()) {
            return Err(contradiction(format!(
                "`{key}`: `{}` holds no items with these arguments",
                taceva_core::shown(&changer.value)
            )));
        }
        if is_simulated_here(rig, drivers) {
            return Err(contradiction(format!(
                "`{key}`: the robot is simulated, and the simulated bench changes specimens and units itself: remove `{key}`"
            )));
        }
    }
    Ok(())
}

/// True if the robot of `rig` moves in its base frame and the file still has the origin and axes of a new file.
pub(crate) fn is_untaught(rig: &RigFile, drivers: &Drivers) -> bool {
    let Some(robot) = &rig.robot else {
        return false;
    };
    let selector: Option<Selector> = robot.driver.value.parse().ok();
    let factory = selector.and_then(|selector| drivers.robots.get(selector.driver()).ok());
    let facts = factory.and_then(|factory| factory.descriptor().robot());
    facts.is_some_and(|facts| facts.base_frame)
        && robot.origin_mm.value.iter().all(|mm| *mm == 0.0)
        && robot.axes.value.to_string() == r#"["x", "y", "z"]"#
}

/// Rejects a robot that was never taught: `origin_mm` and `axes` still have their defaults, which do not describe the gel. Opens no device.
pub(crate) fn check_taught(rig: &RigFile, drivers: &Drivers) -> Result<(), SceneError> {
    match &rig.robot {
        Some(robot) if is_untaught(rig, drivers) => {
            let problem = format!(
                "`origin_mm` and `axes` still have the values of a new file: run taceva rig teach {}; nothing moves until then",
                taceva_core::shown(rig.name())
            );
            Err(rig.error(robot.origin_mm.at(), SceneProblem::Contradiction(problem)))
        }
        _ => Ok(()),
    }
}

/// True if the robot of `rig` is simulated in this program.
fn is_simulated_here(rig: &RigFile, drivers: &Drivers) -> bool {
    let robot = rig.robot.as_ref().map(|robot| &robot.driver.value);
    let robot: Option<Selector> = robot.and_then(|robot| robot.parse().ok());
    let factory = robot.and_then(|robot| drivers.robots.get(robot.driver()).ok());
    let source = factory.map(|factory| factory.descriptor().source());
    source == Some(DriverSource::Simulated)
}

/// Opens the enabling switch of `rig`, if the rig has a switch.
pub(crate) fn open_switch(
    rig: &RigFile,
    drivers: &Drivers,
) -> Result<Option<Arc<dyn EnablingSwitch>>, SceneError> {
    check_switch(rig, drivers)?;
    let Some(operator) = &rig.operator else {
        return Ok(None);
    };
    let enable = &operator.enable;
    let selector: Selector = enable
        .value
        .parse()
        .expect("the check has parsed this selector");
    let opened = drivers.switches.open(&selector).map_err(|error| {
        let problem = format!(
            "`enable`: {error}; plug the switch in and check that this user may read it: nothing moves without it"
        );
        rig.error(enable.at(), SceneProblem::Contradiction(problem))
    });
    opened.map(Some)
}

fn keys<D: Device + ?Sized>(registry: &Registry<D>) -> impl Iterator<Item = (DriverKind, &str)> {
    registry.keys().map(|key| (D::KIND, key.as_str()))
}

fn not_a_selector(device: &Setting<String>) -> Refused {
    let problem = format!(
        "`{}` names no driver, expected `driver` or `driver:key=value;key=value`",
        device.value
    );
    (device.at(), SceneProblem::Contradiction(problem))
}
