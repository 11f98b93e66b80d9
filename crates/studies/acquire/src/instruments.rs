//! Instruments of a recording, with the certificates of the rig file.

use std::time::{SystemTime, UNIX_EPOCH};

use taceva_core::{Certificate, Date, Instrument, Traceability};
use taceva_dataset::Source;
use taceva_drivers::Selector;
use taceva_protocol::RigFile;

/// Instruments of the labels that the devices of `rig` make. The sensor is one of them if it has a certificate.
pub(crate) fn of_rig(rig: &RigFile) -> Vec<Traceability> {
    let force = rig.force.as_ref().map(|force| {
        let driver = &force.driver.value;
        traced(Instrument::Force, driver, force.certificate.as_ref())
    });
    let robot = rig.robot.as_ref().map(|robot| {
        let driver = &robot.driver.value;
        traced(Instrument::Robot, driver, robot.certificate.as_ref())
    });
    let sensor = rig.sensor.as_ref().and_then(|sensor| {
        let certificate = sensor.certificate.as_ref()?;
        let driver = &sensor.driver.value;
        Some(traced(Instrument::Sensor, driver, Some(certificate)))
    });
    [force, robot, sensor].into_iter().flatten().collect()
}

/// Instruments that a recording of `source` keeps: labels that nothing measured need no certificate.
pub(crate) fn kept(instruments: Vec<Traceability>, source: Source) -> Vec<Traceability> {
    let mut kept = instruments;
    kept.retain(|of| source == Source::Recorded || of.certificate.is_some());
    kept
}

/// Today, in UTC, for a recording that measures; certificates are valid for a time.
pub(crate) fn day_of(source: Source) -> Option<Date> {
    let since = SystemTime::now().duration_since(UNIX_EPOCH).ok()?;
    (source == Source::Recorded).then(|| Date::of_unix_s(since.as_secs()))
}

/// The instrument of the device `driver`, a selector. Its serial number is the one that chose it; other drivers read none.
pub(crate) fn traced(
    instrument: Instrument,
    driver: &str,
    certificate: Option<&Certificate>,
) -> Traceability {
    let traced = Traceability::new(instrument);
    let mut traced = match driver.parse::<Selector>() {
        Ok(selector) => {
            let serial = selector.serial().map(str::to_owned);
            traced.with_driver(selector.driver(), serial)
        }
        Err(_) => traced.with_driver(driver, None),
    };
    traced.certificate = certificate.cloned();
    traced
}

#[cfg(test)]
mod tests {
    use super::*;

    const RIG: &str = r#"rig_version = 1
[robot]
driver = "lab/arm:host=10.0.0.2"
carries = "indenter"
origin_mm = [300.0, 0.0, 251.3]
axes = ["x", "-y", "-z"]
[force]
driver = "hid/scale:usb=0922:8003;serial=B2"
axes = ["x", "-y", "-z"]
[force.certificate]
number = "D-K-1"
laboratory = "a laboratory"
issued = 2026-05-12
serial = "B3"
k = 2.0
U = { Fz = "3.0 mN" }
[sensor]
driver = "lab/camera"
"#;

    #[test]
    fn the_transducer_and_the_robot_of_a_rig_are_named_with_serial_and_certificate() {
        let rig = RigFile::parse("lab.toml", RIG).expect("a rig");
        let instruments = of_rig(&rig);
        let [force, robot] = instruments.as_slice() else {
            panic!("{instruments:?}");
        };
        assert_eq!(force.driver.as_deref(), Some("hid/scale"));
        assert!(force.other_serial().is_some_and(|(_, read)| read == "B2"));
        assert_eq!(robot.driver.as_deref(), Some("lab/arm"));
        assert_eq!((&robot.serial, &robot.certificate), (&None, &None));
        assert_eq!(kept(instruments.clone(), Source::Recorded), instruments);
        let drawn = kept(instruments.clone(), Source::Simulated);
        assert_eq!(drawn, std::slice::from_ref(force));
        assert_eq!(day_of(Source::Simulated), None);
        assert!(day_of(Source::Recorded).is_some());
    }
}
