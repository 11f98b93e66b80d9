//! Instruments of a recording, with the certificates of the rig file.

use std::collections::BTreeMap;
use std::time::{SystemTime, UNIX_EPOCH};

use taceva_core::{
    Certificate, CertificateContradiction, CertificateFault, Date, Instrument, Traceability,
};
use taceva_dataset::Source;
use taceva_drivers::Selector;
use taceva_protocol::RigFile;

/// Instruments that measure the labels on `rig`. The sensor is included if it has a certificate.
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

/// Instruments to store in a recording. A serial number that a driver reports in `settings` replaces the serial number in the rig file.
pub(crate) fn kept(
    instruments: Vec<Traceability>,
    settings: &BTreeMap<String, String>,
) -> Vec<Traceability> {
    let mut kept = instruments;
    for of in &mut kept {
        let read = match of.instrument {
            Instrument::Sensor => settings.get("serial"),
            other => settings.get(&format!("{other}_serial")),
        };
        of.serial = read.cloned().or(of.serial.take());
    }
    kept
}

/// Today's date in UTC, for a recording of measurements, because certificates expire; `None` for any other recording.
pub(crate) fn day_of(source: Source) -> Option<Date> {
    today().filter(|_| source == Source::Recorded)
}

/// Today's date in UTC; `None` if the clock of the machine is before 1970.
pub(crate) fn today() -> Option<Date> {
    let since = SystemTime::now().duration_since(UNIX_EPOCH).ok()?;
    Some(Date::of_unix_s(since.as_secs()))
}

/// Contradictions between the certificates of `instruments`, the reported serial numbers, and today's date.
pub(crate) fn faults_today(instruments: &[Traceability]) -> Vec<CertificateFault> {
    let days = today().map(|today| today..=today);
    let faults = instruments.iter();
    let faults = faults.flat_map(|of| of.faults(days.as_ref(), instruments));
    faults.collect()
}

/// Warnings about labels measured today, from the certificates of `instruments` and the `settings` of the devices.
pub(crate) fn warnings_today(
    instruments: Vec<Traceability>,
    settings: &BTreeMap<String, String>,
) -> Vec<String> {
    let instruments = kept(instruments, settings);
    faults_today(&instruments).iter().map(remedy).collect()
}

/// Sentence that describes `fault` and its remedy.
pub(crate) fn remedy(fault: &CertificateFault) -> String {
    let mended = match fault.contradiction {
        CertificateContradiction::IssuedLater { .. } => {
            "correct `issued`, or the clock of this machine"
        }
        CertificateContradiction::Expired { .. } => {
            "have the instrument calibrated again and write the new certificate, or correct `valid_until`"
        }
        _ => "write the certificate of this device, or correct `serial`",
    };
    format!(
        "{fault}: {mended} under [{}.certificate] of the rig file",
        fault.instrument
    )
}

/// Creates the record of the instrument that `driver` selects. If the selector contains a serial number, so does the record.
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
        let none = BTreeMap::new();
        assert_eq!(kept(instruments.clone(), &none), instruments);
        assert_eq!(day_of(Source::Simulated), None);
        assert!(day_of(Source::Recorded).is_some());
    }

    #[test]
    fn a_certificate_that_contradicts_today_or_the_device_is_a_warning_with_its_remedy() {
        let warned = |text: &str, settings: &[(&str, &str)]| {
            let rig = RigFile::parse("lab.toml", text).expect("a rig");
            let pairs = settings.iter();
            let pairs = pairs.map(|(name, value)| ((*name).to_owned(), (*value).to_owned()));
            warnings_today(of_rig(&rig), &pairs.collect())
        };
        let read = [("force_serial", "B3"), ("serial", "D2")];
        let long_ago = RIG.replace("2026-05-12", "2020-05-12");
        assert_eq!(warned(&long_ago, &read), Vec::<String>::new());
        let expired = long_ago.replace(
            "serial = \"B3\"",
            "serial = \"B3\"\nvalid_until = 2021-05-12",
        );
        let found = warned(&expired, &read);
        assert_eq!(found.len(), 1, "{found:?}");
        assert!(found[0].contains("was valid until 2021-05-12"), "{found:?}");
        assert!(found[0].contains("under [force.certificate]"), "{found:?}");
        let later = warned(&RIG.replace("2026-05-12", "9026-05-12"), &read);
        assert!(later[0].contains("was issued on 9026-05-12"), "{later:?}");
        // The serial number of the sensor is compared like that of the transducer.
        let (_, certificate) = long_ago.split_once("[force.certificate]").expect("one");
        let (certificate, _) = certificate.split_once("[sensor]").expect("a sensor");
        let of_sensor = format!("{long_ago}[sensor.certificate]{certificate}");
        let other = warned(&of_sensor, &read);
        assert_eq!(other.len(), 1, "{other:?}");
        assert!(
            other[0].contains("of the sensor is for serial number B3, but the driver read D2"),
            "{other:?}"
        );
    }

    #[test]
    fn a_serial_number_that_a_driver_reads_is_compared_with_the_certificate() {
        let rig = RigFile::parse("lab.toml", &RIG.replace(";serial=B2", "")).expect("a rig");
        let read = |name: &str| BTreeMap::from([(name.to_owned(), "B4".to_owned())]);
        let with = |name: &str| kept(of_rig(&rig), &read(name));
        let of_force = with("force_serial");
        let other = of_force[0].other_serial();
        assert!(other.is_some_and(|(_, read)| read == "B4"));
        assert_eq!(of_force[1].serial, None);
        let of_robot = with("robot_serial");
        assert_eq!(of_robot[0].serial, None);
        assert_eq!(of_robot[1].serial.as_deref(), Some("B4"));
    }
}
