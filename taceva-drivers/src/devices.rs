//! List of all drivers and of the devices that they find. Listing opens no device.

use serde::Serialize;
use taceva_core::{
    ArgSpec, Descriptor, Device, DriverError, DriverKind, DriverSource, Facts, Found, Presence,
    Registry,
};

use crate::drivers::Drivers;

/// Drivers of a program, the devices they find, and failed searches.
#[derive(Debug)]
pub struct Devices {
    /// Drivers of sensors, robots, force transducers, lightings and changers; sorted by key within each kind.
    pub drivers: Vec<ListedDriver>,
    /// Drivers of enabling switches, sorted by key.
    pub switches: Vec<ListedSwitch>,
    /// All devices found, in the order of the drivers.
    pub found: Vec<ListedDevice>,
    /// Errors of drivers whose search failed.
    pub failed: Vec<DriverError>,
}

/// Lists drivers and devices for the command `taceva devices`.
pub fn devices(drivers: &Drivers) -> Devices {
    let mut devices = Devices {
        drivers: Vec::new(),
        switches: ListedSwitch::all(drivers),
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

/// Device that a search found.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct ListedDevice {
    /// Selector that opens the device.
    pub selector: String,
    /// Title of the device.
    pub title: String,
    /// Access of the user to the device, with the remedy if access is denied.
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

/// Driver with the known facts about its device.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ListedDriver {
    /// Key of the driver, such as `sim/robot`.
    pub key: String,
    /// Title of the driver.
    pub title: String,
    /// Kind of device that the driver opens.
    pub kind: DriverKind,
    /// Origin of the readings: a real device, a simulation or a replay.
    pub source: DriverSource,
    /// Size and format of the sensor's frames.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frame: Option<String>,
    /// Rate of the frames or readings, Hz.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rate_hz: Option<f64>,
    /// True if the gel is opaque.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub opaque: Option<bool>,
    /// True if the gel has markers.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub markers: Option<bool>,
    /// Maximum depth of a press into the gel, mm.
    #[serde(rename = "Pz_max_mm", skip_serializing_if = "Option::is_none")]
    pub depth_max_mm: Option<f64>,
    /// Maximum force on the gel, or measuring range of the transducer, N.
    #[serde(rename = "Fz_max_N", skip_serializing_if = "Option::is_none")]
    pub force_max_n: Option<f64>,
    /// Components of force and torque that a transducer measures.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub axes: Option<String>,
    /// Speed limit of a robot, mm/s.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub speed_max_mm_s: Option<f64>,
    /// Names of the scenes that a lighting device can set.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub scenes: Vec<String>,
    /// Names of the items that a changer holds.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub holds: Vec<String>,
    /// Arguments that the driver accepts.
    pub arguments: Vec<ListedArgument>,
}

/// Driver of an enabling switch. A rig file selects it with `enable` under `[operator]`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ListedSwitch {
    /// Key of the driver, such as `hid/pedal`.
    pub key: String,
    /// Title of the driver.
    pub title: String,
    /// Arguments that the driver accepts.
    pub arguments: Vec<ListedArgument>,
}

impl ListedSwitch {
    fn all(drivers: &Drivers) -> Vec<ListedSwitch> {
        let switches = drivers.switches.iter();
        switches
            .map(|(key, title, arguments)| ListedSwitch {
                key: key.to_owned(),
                title: title.to_owned(),
                arguments: arguments.iter().map(ListedArgument::of).collect(),
            })
            .collect()
    }
}

/// Argument of a driver.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ListedArgument {
    /// Name of the argument.
    pub key: String,
    /// Accepted values, in words.
    pub takes: String,
    /// True if the argument is required.
    pub required: bool,
    /// Default value; `None` if there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub default: Option<String>,
    /// Help text.
    pub help: String,
}

impl ListedDriver {
    /// Lists a driver from its descriptor.
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
            // A kind of a later version is listed with its key, title and arguments.
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
