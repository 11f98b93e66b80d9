//! Everything that decides what a simulated study records.

use taceva_core::{ArgKind, Device, Registry};
use taceva_drivers::{Drivers, Selector};
use taceva_protocol::Setting;

use super::devices::OpenRig;
use super::workshop::Workshop;
use crate::cache::{Key, Stage};
use crate::scene::{PlannedStudy, RigSpec};

/// The parts of a written plan that say what is computed of a recording, and not what is recorded.
const OF_SCORES: [&str; 4] = ["metrics", "fits", "skipped", "cost"];

/// The key of the recording of `study`; `None` if a device is real or told to read a file, or if the rig cannot say what it is a model of.
///
/// The devices of each unit are opened, because what they are models of is known to them alone: the version and the parameters of the
/// bench are in the name of its gel. Opening what is only a model moves nothing.
pub(crate) fn key(study: &PlannedStudy, rig: &RigSpec, workshop: Workshop<'_>) -> Option<Key> {
    if !rig.is_only_simulated(workshop.drivers) {
        return None;
    }
    let plan = &study.plan;
    let mut written = serde_json::to_value(plan).ok()?;
    let fields = written.as_object_mut()?;
    OF_SCORES
        .iter()
        .for_each(|field| drop(fields.remove(*field)));
    let mut key = Key::of(Stage::Acquire)
        .part("plan", &written.to_string())
        .whole("opaque", &plan.opaque)
        .whole("footprint", &plan.footprint);
    for unit in &plan.units {
        for selector in selectors(rig, unit, workshop.drivers)? {
            key = key.whole("device", &selector.map(|selector| selector.to_string()));
        }
        let open = OpenRig::open(study, rig, unit, workshop).ok()?;
        key = key.part("model", open.surroundings.gel.as_deref()?);
    }
    Some(key.finish())
}

/// What opens each device of `rig` for `unit`.
fn selectors(rig: &RigSpec, unit: &str, drivers: &Drivers) -> Option<[Option<Selector>; 4]> {
    fn of<D: Device + ?Sized>(
        (rig, unit): (&RigSpec, &str),
        registry: &Registry<D>,
        device: Option<&Setting<String>>,
    ) -> Option<Option<Selector>> {
        let Some(device) = device else {
            return Some(None);
        };
        let selector = rig.selector(registry, device, unit).ok()?;
        let factory = registry.get(selector.driver()).ok()?;
        let mut taken = factory.descriptor().arguments().iter();
        let reads_file = taken.any(|argument| {
            // What a file holds can change under its name.
            argument.kind == ArgKind::Path && selector.arguments().contains(&argument.key[..])
        });
        (!reads_file).then_some(Some(selector))
    }
    let way = (rig, unit);
    Some([
        of(way, &drivers.sensors, rig.sensor.as_ref())?,
        of(way, &drivers.robots, rig.robot.as_ref())?,
        of(way, &drivers.forces, rig.force.as_ref())?,
        of(way, &drivers.lightings, rig.lighting.as_ref())?,
    ])
}
