//! What there is: every driver, and every device that one of them sees. Data for a list; nothing is opened.

use serde::Serialize;
use taceva_core::{
    ArgSpec, Descriptor, Device, DriverError, DriverKind, DriverSource, Facts, Found, Presence,
    Registry,
};

use crate::drivers::Drivers;

/// The drivers of a program, the devices they see, and what kept one of them from looking.
#[derive(Debug)]
pub struct Devices {
    /// Every driver: sensors, robots, force transducers, lightings, changers; by key within a kind.
    pub drivers: Vec<ListedDriver>,
    /// Every device that is present, in the order of the drivers.
    pub found: Vec<ListedDevice>,
    /// Drivers that could not look.
    pub failed: Vec<DriverError>,
}

/// What `taceva devices` shows.
pub fn devices(drivers: &Drivers) -> Devices {
    let mut devices = Devices {
        drivers: Vec::new(),
        found: Vec::new(),
        failed: Vec::new(),
    };
    devices.visit(&drivers.sensors);
    devices.visit(&drivers.robots);
    devices.visit(&drivers.forces);
    devices.visit(&drivers.lightings);
    devices.visit(&drivers.changers);
    devices
}

impl Devices {
    fn visit<D: Device + ?Sized>(&mut self, registry: &Registry<D>) {
        for factory in registry.iter() {
            self.drivers.push(ListedDriver::of(factory.descriptor()));
            match factory.discover() {
                Ok(found) => self.found.extend(found.iter().map(ListedDevice::of)),
                Err(error) => self.failed.push(error),
            }
        }
    }
}

/// A device that is present.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct ListedDevice {
    /// What opens it: a selector.
    pub selector: String,
    /// What it calls itself.
    pub title: String,
    /// Whether it could be opened, and what would change that.
    pub access: String,
}

impl ListedDevice {
    fn of(found: &Found) -> ListedDevice {
        let separator = if found.arguments.is_empty() { "" } else { ":" };
        ListedDevice {
            selector: format!("{}{separator}{}", found.driver, found.arguments),
            title: found.title.clone(),
            access: found.access.to_string(),
        }
    }
}

/// A driver and what is known about its device; what is not known is absent.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ListedDriver {
    /// Its key.
    pub key: String,
    /// Its title.
    pub title: String,
    /// The kind of its device.
    pub kind: DriverKind,
    /// Where its readings come from.
    pub source: DriverSource,
    /// Size and format of its frames.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frame: Option<String>,
    /// Frames or readings a second.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rate_hz: Option<f64>,
    /// Whether the gel is opaque.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub opaque: Option<bool>,
    /// Whether the gel has markers.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub markers: Option<bool>,
    /// How deep the gel may be pressed.
    #[serde(rename = "Pz_max_mm", skip_serializing_if = "Option::is_none")]
    pub depth_max_mm: Option<f64>,
    /// How hard the gel may be pressed, or how much the transducer measures.
    #[serde(rename = "Fz_max_N", skip_serializing_if = "Option::is_none")]
    pub force_max_n: Option<f64>,
    /// The components that a force transducer measures.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub axes: Option<String>,
    /// The greatest speed of a robot.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub speed_max_mm_s: Option<f64>,
    /// The scenes of the light that it can set.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub scenes: Vec<String>,
    /// The names of what a changer holds.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub holds: Vec<String>,
    /// The arguments that it accepts.
    pub arguments: Vec<ListedArgument>,
}

/// An argument of a driver.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ListedArgument {
    /// Its key.
    pub key: String,
    /// The values that it takes, in words.
    pub takes: String,
    /// Whether it must be given.
    pub required: bool,
    /// What it is where it is not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub default: Option<String>,
    /// What it means.
    pub help: String,
}

impl ListedDriver {
    /// A driver as its descriptor describes it.
    pub fn of(descriptor: &Descriptor) -> ListedDriver {
        let mut listed = ListedDriver {
            key: descriptor.key().to_string(),
            title: descriptor.title().to_owned(),
            kind: descriptor.kind(),
            source: descriptor.source(),
            frame: None,
            rate_hz: None,
            opaque: None,
            markers: None,
            depth_max_mm: None,
            force_max_n: None,
            axes: None,
            speed_max_mm_s: None,
            scenes: Vec::new(),
            holds: Vec::new(),
            arguments: descriptor
                .arguments()
                .iter()
                .map(ListedArgument::of)
                .collect(),
        };
        match descriptor.facts() {
            Facts::Sensor(facts) => {
                listed.frame = facts.frame.map(|frame| frame.to_string());
                listed.rate_hz = facts.rate.map(|rate| rate.0);
                listed.opaque = facts.opaque;
                listed.markers = facts.markers;
                listed.depth_max_mm = facts.depth_limit().map(|depth| depth.0);
                listed.force_max_n = facts.force_max.map(|force| force.0);
                listed.scenes.clone_from(&facts.scenes);
            }
            Facts::Robot(facts) => {
                listed.speed_max_mm_s = facts.speed_max.map(|speed| speed.mm_per_s());
            }
            Facts::Force(facts) => {
                listed.axes = Some(facts.axes.to_string());
                listed.rate_hz = facts.rate.map(|rate| rate.0);
                listed.force_max_n = facts.force_max.map(|force| force.0);
            }
            Facts::Lighting(facts) => listed.scenes.clone_from(&facts.scenes),
            Facts::Changer(facts) => listed.holds.clone_from(&facts.holds),
            // A kind of a later version is listed by its name, title and arguments.
            _ => {}
        }
        listed
    }
}

impl ListedArgument {
    fn of(spec: &ArgSpec) -> ListedArgument {
        ListedArgument {
            key: spec.key.clone(),
            takes: spec.expected(),
            required: spec.presence == Presence::Required,
            default: match &spec.presence {
                Presence::Default(value) => Some(value.to_string()),
                Presence::Required | Presence::Optional => None,
            },
            help: spec.help.clone(),
        }
    }
}
