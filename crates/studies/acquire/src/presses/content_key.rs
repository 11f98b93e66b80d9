//! Content key of a simulated study, computed from all inputs that determine its recording.

use taceva_core::{ArgKind, Device, Registry};
use taceva_drivers::Drivers;
use taceva_protocol::Setting;

use crate::instruments;
use crate::scene::{PlannedStudy, RigSpec, StudySource};

/// Fields of a serialised plan that affect the scores but not the recording.
const OF_SCORES: [&str; 4] = ["metrics", "fits", "skipped", "cost"];

impl PlannedStudy {
    /// Named parts of the content key of the study's recording. `None` for an existing recording, for a real device, and for an argument that names a file,
    /// because its content can change.
    ///
    /// Opens no device, because the arguments of simulated devices are in their selectors.
    pub fn content_key(&self, drivers: &Drivers) -> Option<Vec<(&'static str, String)>> {
        let StudySource::Rig(rig) = &self.source else {
            return None;
        };
        if !rig.is_only_simulated(drivers) {
            return None;
        }
        let plan = &self.plan;
        let mut written = serde_json::to_value(plan).ok()?;
        let fields = written.as_object_mut()?;
        for field in OF_SCORES {
            fields.remove(field);
        }
        let mut parts = vec![
            ("plan", written.to_string()),
            ("opaque", format!("{:?}", plan.opaque)),
            ("footprint", format!("{:?}", plan.footprint)),
        ];
        let rig_file = self.study.rig.as_deref();
        let instruments = rig_file.map(instruments::of_rig).unwrap_or_default();
        if instruments.iter().any(|of| of.certificate.is_some()) {
            parts.push(("instruments", format!("{instruments:?}")));
        }
        for unit in &plan.units {
            let opened = devices(rig, unit, drivers)?.into_iter();
            parts.extend(opened.map(|device| ("device", format!("{device:?}"))));
        }
        Some(parts)
    }
}

/// Selector of a device, and the build of its driver if the driver is a plugin.
#[derive(Debug)]
#[expect(dead_code, reason = "the Debug format reads the fields")]
struct Opened {
    selector: String,
    build: Option<String>,
}

/// Selectors of the devices of `rig` for `unit`; `None` for a real device, or for an argument that names a file.
fn devices(rig: &RigSpec, unit: &str, drivers: &Drivers) -> Option<[Option<Opened>; 4]> {
    fn of<D: Device + ?Sized>(
        rig: &RigSpec,
        unit: &str,
        registry: &Registry<D>,
        device: Option<&Setting<String>>,
    ) -> Option<Option<Opened>> {
        let Some(device) = device else {
            return Some(None);
        };
        let selector = rig.selector(registry, device, unit).ok()?;
        let factory = registry.get(selector.driver()).ok()?;
        let mut taken = factory.descriptor().arguments().iter();
        let reads_file = taken.any(|argument| {
            argument.kind == ArgKind::Path && selector.arguments().contains(&argument.key[..])
        });
        let build = factory.build().ok()?;
        (!reads_file).then(|| {
            Some(Opened {
                selector: selector.to_string(),
                build,
            })
        })
    }
    Some([
        of(rig, unit, &drivers.sensors, rig.sensor.as_ref())?,
        of(rig, unit, &drivers.robots, rig.robot.as_ref())?,
        of(rig, unit, &drivers.forces, rig.force.as_ref())?,
        of(rig, unit, &drivers.lightings, rig.lighting.as_ref())?,
    ])
}
