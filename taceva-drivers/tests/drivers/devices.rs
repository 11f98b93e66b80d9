//! Listing of drivers and devices, and opening of one by name.

use taceva_core::{
    Access, ArgSpec, Args, Descriptor, DescriptorSpec, DriverError, DriverKey, DriverSource,
    ErrorKind, Factory, Facts, Found, Millimetre, Rig, Sensor, SensorFacts,
};
use taceva_drivers::{Drivers, devices, open};

/// Driver that finds two cameras, or fails to search.
struct Cameras {
    descriptor: Descriptor,
    can_look: bool,
}

impl Cameras {
    fn boxed(key: &'static str, can_look: bool) -> Box<Cameras> {
        let facts = SensorFacts::default()
            .with_opaque(true)
            .with_depth_max(Millimetre(1.5));
        let facts = Facts::Sensor(Box::new(facts));
        let key = DriverKey::fixed(key);
        let spec = DescriptorSpec::new(key, "cameras", DriverSource::Real, facts);
        Box::new(Cameras {
            descriptor: spec.check().expect("no contradiction"),
            can_look,
        })
    }

    fn error(&self, kind: ErrorKind, doing: &'static str) -> DriverError {
        DriverError::new(kind, self.descriptor.key(), doing)
    }
}

impl Factory<dyn Sensor> for Cameras {
    fn descriptor(&self) -> &Descriptor {
        &self.descriptor
    }
    fn open(&self, _: &Args, _: &mut Rig) -> Result<Box<dyn Sensor>, DriverError> {
        Err(self.error(ErrorKind::Busy, "open /dev/video0"))
    }
    fn discover(&self) -> Result<Vec<Found>, DriverError> {
        if !self.can_look {
            return Err(self.error(ErrorKind::PermissionDenied, "look for cameras"));
        }
        let found = |arguments: &str, access| {
            Found::new(self.descriptor.key().clone(), "a camera")
                .with_arguments(arguments.to_owned())
                .with_access(access)
        };
        let remedy = "join the group `video`".to_owned();
        Ok(vec![
            found("serial=D20042", Access::Ready),
            found("", Access::Denied { remedy }),
        ])
    }
}

fn drivers() -> Drivers {
    let mut drivers = Drivers::builtin().expect("no contradiction");
    for (key, can_look) in [("test/seeing", true), ("test/blind", false)] {
        drivers
            .sensors
            .add(Cameras::boxed(key, can_look))
            .expect("new");
    }
    drivers
}

#[test]
fn the_list_has_every_driver_what_it_sees_and_why_another_could_not_look() {
    let listed = devices(&drivers());
    let sensors = listed
        .drivers
        .iter()
        .filter(|driver| driver.kind.name() == "sensor");
    let mut keys: Vec<_> = sensors.map(|driver| driver.key.as_str()).collect();
    // Drivers of real cameras depend on features.
    keys.retain(|key| !key.starts_with("camera/"));
    assert_eq!(keys, ["sensor/replay", "test/blind", "test/seeing"]);
    let found: Vec<_> = listed
        .found
        .iter()
        .map(|device| (device.selector.as_str(), device.access.as_str()))
        .collect();
    assert_eq!(
        found,
        [
            ("test/seeing:serial=D20042", "ready"),
            (
                "test/seeing",
                "seen, but not permitted: join the group `video`"
            ),
        ]
    );
    assert_eq!(listed.failed.len(), 1);
    assert_eq!(
        listed.failed[0].to_string(),
        "test/blind: cannot look for cameras: permission denied"
    );
}

#[test]
fn what_is_not_known_of_a_device_is_absent_from_the_list() {
    let listed = devices(&drivers());
    let value = |key: &str| {
        let mut drivers = listed.drivers.iter();
        let driver = drivers.find(|driver| driver.key.as_str() == key);
        serde_json::to_value(driver.expect("listed")).expect("plain values")
    };
    let seeing = value("test/seeing");
    assert_eq!(
        seeing,
        serde_json::json!({
            "key": "test/seeing",
            "title": "cameras",
            "kind": "sensor",
            "source": "real",
            "opaque": true,
            "Pz_max_mm": 1.5,
            "arguments": [],
        })
    );
    let replay = value("sensor/replay");
    assert_eq!(
        replay["arguments"][1],
        serde_json::json!({
            "key": "rate",
            "takes": "a number from 0.001 to 100000 Hz",
            "required": false,
            "default": "30",
            "help": "frames per second, if no table of times is given",
        })
    );
}

#[test]
fn an_enabling_switch_is_listed_with_its_title_and_arguments_and_is_not_opened() {
    let mut drivers = drivers();
    let arguments = vec![ArgSpec::text("usb").help("its number")];
    let key = DriverKey::fixed("test/foot");
    let switches = &mut drivers.switches;
    switches.add(key, "a foot switch", arguments, |_| {
        panic!("a list opens nothing")
    });
    assert!(drivers.switches.has("test/foot") && !drivers.switches.has("test/seeing"));
    let listed = devices(&drivers).switches;
    let foot = listed.iter().find(|switch| switch.key == "test/foot");
    let foot = serde_json::to_value(foot.expect("listed")).expect("plain values");
    assert_eq!(foot["title"], "a foot switch");
    assert_eq!(foot["arguments"][0]["key"], "usb");
    assert_eq!(foot["arguments"][0]["help"], "its number");
}

#[test]
fn a_device_that_does_not_open_keeps_its_kind_of_failure() {
    let drivers = drivers();
    let selector = "test/seeing".parse().expect("a selector");
    let error = open(&drivers.sensors, &selector, &mut Rig::new())
        .map(|_| ())
        .expect_err("held");
    assert_eq!(error.kind(), ErrorKind::Busy);
    assert_eq!(
        error.to_string(),
        "test/seeing: cannot open /dev/video0: busy"
    );
}
