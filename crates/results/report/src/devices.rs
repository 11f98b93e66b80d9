//! Devices of the recordings behind results: facts from the recording, for the methods paragraph and for a table.

use std::collections::BTreeMap;

use taceva_core::{Instrument, Traceability, distinct};

use crate::names::names;
use crate::results::Study;
use crate::table::{Cell, Column, Table};

/// A device of a recording with its known facts.
pub(crate) struct Device {
    pub(crate) kind: &'static DeviceKind,
    pub(crate) facts: Vec<DeviceFact>,
}

/// Kind of a device.
pub(crate) struct DeviceKind {
    instrument: Instrument,
    /// Prefix of the names of the device settings.
    prefix: &'static str,
    pub(crate) name: &'static str,
    /// Predicate of a sentence on the device, such as `moved the tip`.
    pub(crate) work: &'static str,
}

/// A fact of a device.
#[derive(Clone, PartialEq)]
pub(crate) struct DeviceFact {
    name: String,
    value: String,
    /// Words for the fact in a sentence.
    pub(crate) words: String,
}

impl DeviceFact {
    /// A fact with the words `name value`, such as `driver camera/v4l2`.
    fn named(name: &str, value: &str) -> DeviceFact {
        DeviceFact {
            name: name.to_owned(),
            value: value.to_owned(),
            words: format!("{name} {value}"),
        }
    }
}

/// Devices that record the labels and the frames.
static KINDS: [DeviceKind; 3] = [
    DeviceKind {
        instrument: Instrument::Force,
        prefix: "force_",
        name: "force transducer",
        work: "measured the forces",
    },
    DeviceKind {
        instrument: Instrument::Robot,
        prefix: "robot_",
        name: "robot",
        work: "moved the tip",
    },
    DeviceKind {
        instrument: Instrument::Sensor,
        prefix: "sensor_",
        name: "sensor",
        work: "recorded the frames",
    },
];

/// Settings that are not facts of a device: the digest of the rig file, the laboratory and the operator.
const OF_NO_DEVICE: [&str; 3] = ["rig_file", "laboratory", "operator"];

/// Devices of the measured recording of `study` that have a known fact. A simulated recording has no devices.
pub(crate) fn devices(study: &Study) -> Vec<Device> {
    if study.is_simulated() {
        return Vec::new();
    }
    let devices = KINDS.iter().map(|kind| Device {
        kind,
        facts: kind.facts(study),
    });
    devices.filter(|device| !device.facts.is_empty()).collect()
}

/// Table of the devices of measured recordings; `None` if no recording states a device.
///
/// ```
/// let result = r#"{"schema": "taceva.evaluation/1.0", "subject": {"sensor": "gel", "source": "recorded"}, "metrics": {},
///     "provenance": {"devices": {"force_rate_hz": "500"}}}"#;
/// let sealed = taceva_files::seal::json::seal(result)?;
/// let table = taceva_report::device_table(&taceva_report::Study::read(&sealed)?).ok_or("a device")?;
/// assert_eq!(table.csv(), "sensor,device,fact,value\ngel,force transducer,rate_hz,500\n");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn device_table(studies: &[Study]) -> Option<Table> {
    let heads = ["sensor", "device", "fact", "value"].map(Column::new);
    let mut table = Table::new("Devices of the recordings", heads);
    for (study, name) in studies.iter().zip(names(studies)) {
        for Device { kind, facts } in devices(study) {
            for fact in facts {
                let cells = [name.as_str(), kind.name, &fact.name, &fact.value];
                table.push(cells.map(Cell::text));
            }
        }
    }
    (!table.rows.is_empty()).then_some(table)
}

impl DeviceKind {
    /// Known facts of the device, each once.
    fn facts(&self, study: &Study) -> Vec<DeviceFact> {
        let traced = study.references.iter();
        let traced = traced.filter(|of| of.instrument == self.instrument);
        distinct(traced.flat_map(identity).chain(self.settings(study)))
    }

    /// Settings of the device as facts. A camera's own settings have no prefix.
    fn settings(&self, study: &Study) -> Vec<DeviceFact> {
        let mut own: BTreeMap<&str, &str> = BTreeMap::new();
        for (name, value) in &study.made.devices {
            let is_of_any = KINDS.iter().any(|kind| name.starts_with(kind.prefix));
            let is_other = is_of_any || OF_NO_DEVICE.contains(&name.as_str());
            let is_bare = self.instrument == Instrument::Sensor && !is_other;
            let bare = name.strip_prefix(self.prefix);
            if let Some(bare) = bare.or(is_bare.then_some(name.as_str())) {
                own.insert(bare, value);
            }
        }
        let mut facts = Vec::new();
        let driver = own.remove("driver");
        facts.extend(driver.map(|key| DeviceFact::named("driver", key)));
        let serial = own.remove("serial");
        facts.extend(serial.map(|number| DeviceFact::named("serial number", number)));
        let mut measured = |name: &str, u_name: &str| {
            let value = own.remove(name)?;
            let u = own.remove(u_name).map(|u| format!(" ± {u}"));
            Some(format!("{value}{}", u.unwrap_or_default()))
        };
        let latency = measured("latency_ms", "latency_u_ms");
        let drift = measured("clock_drift_ppm", "clock_drift_u_ppm");
        facts.extend(own.into_iter().map(|(name, value)| DeviceFact {
            name: name.to_owned(),
            value: value.to_owned(),
            words: format!("{name} = {value}"),
        }));
        facts.extend(latency.map(|value| DeviceFact {
            name: "latency_ms".to_owned(),
            words: format!("latency of {value} ms subtracted from its stamps"),
            value,
        }));
        facts.extend(drift.map(|value| DeviceFact {
            name: "clock_drift_ppm".to_owned(),
            words: format!("clock that drifted by {value} ppm"),
            value,
        }));
        facts
    }
}

/// Driver, serial number and certificate of an instrument, as far as they are known.
fn identity(of: &Traceability) -> Vec<DeviceFact> {
    let certificate = of.certificate.as_ref().map(|of| {
        let (number, laboratory, issued) = (&of.number, &of.laboratory, of.issued);
        DeviceFact::named(
            "certificate",
            &format!("{number} of {laboratory}, {issued}"),
        )
    });
    let driver = of.driver.as_deref();
    let driver = driver.map(|key| DeviceFact::named("driver", key));
    let serial = of.serial.as_deref();
    let serial = serial.map(|number| DeviceFact::named("serial number", number));
    [driver, serial, certificate]
        .into_iter()
        .flatten()
        .collect()
}
