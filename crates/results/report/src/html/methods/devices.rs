//! Sentences of the methods paragraph on the devices that made a recording.

use std::collections::BTreeMap;

use taceva_core::{Instrument, Traceability};

use crate::names::{listed, names};
use crate::results::Study;

/// A device of a recording.
struct Device {
    instrument: Instrument,
    /// Beginning of the names of its settings.
    prefix: &'static str,
    named: &'static str,
    did: &'static str,
}

/// Devices that make the labels and the frames.
const DEVICES: [Device; 3] = [
    Device {
        instrument: Instrument::Force,
        prefix: "force_",
        named: "force transducer",
        did: "measured the forces",
    },
    Device {
        instrument: Instrument::Robot,
        prefix: "robot_",
        named: "robot",
        did: "moved the tip",
    },
    Device {
        instrument: Instrument::Sensor,
        prefix: "sensor_",
        named: "sensor",
        did: "recorded the frames",
    },
];

/// Setting that identifies the rig file, which is no fact of a device.
const RIG_FILE: &str = "rig_file";

/// Sentences on the devices of measured recordings, each fact as the recording states it. Studies with the same devices share their sentences.
pub(super) fn devices(studies: &[Study]) -> String {
    let mut shared: Vec<(String, Vec<String>)> = Vec::new();
    for (study, name) in studies.iter().zip(names(studies)) {
        if study.is_simulated() {
            continue;
        }
        let devices = DEVICES.iter().filter_map(|device| device.sentence(study));
        let sentences: Vec<String> = devices.collect();
        if sentences.is_empty() {
            continue;
        }
        let text = sentences.join("; ");
        match shared.iter_mut().find(|(known, _)| *known == text) {
            Some((_, of)) => of.push(name),
            None => shared.push((text, vec![name])),
        }
    }
    let sentence = |(text, of): (String, Vec<String>)| match of.len() == studies.len() {
        true => format!(" Devices: {text}."),
        false => format!(" Devices of {}: {text}.", listed(&of)),
    };
    shared.into_iter().map(sentence).collect()
}

impl Device {
    /// The device with its known facts, and its work; `None` without a fact.
    fn sentence(&self, study: &Study) -> Option<String> {
        let traced = study.references.iter();
        let traced = traced.filter(|of| of.instrument == self.instrument);
        let mut facts: Vec<String> = Vec::new();
        let stated = traced.flat_map(identity).chain(self.settings(study));
        for fact in stated {
            if !facts.contains(&fact) {
                facts.push(fact);
            }
        }
        let (named, did) = (self.named, self.did);
        (!facts.is_empty()).then(|| format!("the {named} ({}) {did}", facts.join("; ")))
    }

    /// Settings of the device as facts. A camera's own settings have no prefix.
    fn settings(&self, study: &Study) -> Vec<String> {
        let all = &study.made.devices;
        let mut own: BTreeMap<&str, &str> = BTreeMap::new();
        for (name, value) in all {
            let is_of_any = DEVICES.iter().any(|device| name.starts_with(device.prefix));
            let is_bare = self.instrument == Instrument::Sensor && !is_of_any && name != RIG_FILE;
            let bare = name.strip_prefix(self.prefix);
            if let Some(bare) = bare.or(is_bare.then_some(name.as_str())) {
                own.insert(bare, value);
            }
        }
        let mut facts = Vec::new();
        facts.extend(own.remove("driver").map(driver));
        facts.extend(own.remove("serial").map(serial));
        let mut measured = |name: &str, u_name: &str| {
            let value = own.remove(name)?;
            let u = own.remove(u_name).map(|u| format!(" ± {u}"));
            Some(format!("{value}{}", u.unwrap_or_default()))
        };
        let latency = measured("latency_ms", "latency_u_ms");
        let drift = measured("clock_drift_ppm", "clock_drift_u_ppm");
        let others = own.iter().map(|(name, value)| format!("{name} = {value}"));
        facts.extend(others);
        facts.extend(latency.map(|ms| format!("latency of {ms} ms subtracted from its stamps")));
        facts.extend(drift.map(|ppm| format!("clock that drifted by {ppm} ppm")));
        facts
    }
}

/// Driver, serial number and certificate of an instrument, as far as they are known.
fn identity(of: &Traceability) -> Vec<String> {
    let certificate = of.certificate.as_ref().map(|of| {
        let (number, laboratory, issued) = (&of.number, &of.laboratory, of.issued);
        format!("certificate {number} of {laboratory}, {issued}")
    });
    let driver = of.driver.as_deref().map(driver);
    let serial = of.serial.as_deref().map(serial);
    [driver, serial, certificate]
        .into_iter()
        .flatten()
        .collect()
}

fn driver(key: &str) -> String {
    format!("driver {key}")
}

fn serial(number: &str) -> String {
    format!("serial number {number}")
}
