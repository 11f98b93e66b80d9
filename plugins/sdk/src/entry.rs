//! Start and end of a plugin, and access of the host to its drivers.

#![expect(unsafe_code, reason = "functions that a host calls")]

use std::collections::BTreeSet;
use std::ffi::c_void;
use std::ptr::null;

use taceva_abi::{
    CHANGER_FACTORY, ESTIMATOR_FACTORY, Error, FORCE_FACTORY, Factory, Host, LIGHTING_FACTORY,
    ROBOT_FACTORY, SENSOR_FACTORY, Status, Text,
};
use taceva_core::{
    Changer, DescriptorError, ErrorKind, Factory as CoreFactory, ForceTransducer, Lighting, Robot,
    Sensor,
};

use crate::calls::Kind;
use crate::driver::{Driver, Made};
use crate::driver_lists::{Loaded, Tables, keep, loaded};
use crate::export::Export;
use crate::failure::Failure;
use crate::guard::{caught, guard};
use crate::{estimator, factory, host, memory};

pub(crate) unsafe extern "C" fn init<E: Export>(host: *const Host, error: *mut Error) -> Status {
    let work = || {
        // SAFETY: a host passes its table, which begins with its size, for the life of the plugin.
        unsafe { memory::sized("host", host) }?;
        if loaded().is_err() {
            let drivers = load(E::drivers())
                .map_err(|error| Failure::new(ErrorKind::Internal, error.to_string()))?;
            keep(drivers);
        }
        host::remember(host);
        Ok(())
    };
    // SAFETY: the host guarantees that `error` is valid.
    unsafe { guard(error, work) }
}

fn load(drivers: Vec<Driver>) -> Result<Loaded, DescriptorError> {
    let (mut sensors, mut robots, mut forces) = (Vec::new(), Vec::new(), Vec::new());
    let (mut lightings, mut changers, mut estimators) = (Vec::new(), Vec::new(), Vec::new());
    for driver in drivers {
        match driver {
            Driver::Sensor(driver) => sensors.push(driver.factory()?),
            Driver::Robot(driver) => robots.push(driver.factory()?),
            Driver::Force(driver) => forces.push(driver.factory()?),
            Driver::Lighting(driver) => lightings.push(driver.factory()?),
            Driver::Changer(driver) => changers.push(driver.factory()?),
            Driver::Estimator(make) => estimators.push(make()),
            Driver::Made(Made::Sensor(made)) => sensors.push(made),
            Driver::Made(Made::Robot(made)) => robots.push(made),
            Driver::Made(Made::Force(made)) => forces.push(made),
            Driver::Made(Made::Lighting(made)) => lightings.push(made),
            Driver::Made(Made::Changer(made)) => changers.push(made),
            Driver::Made(Made::Estimator(made)) => estimators.push(made),
        }
    }
    let mut prefixes = BTreeSet::new();
    prefixes.extend(sensors.iter().map(|driver| prefix(&**driver)));
    prefixes.extend(robots.iter().map(|driver| prefix(&**driver)));
    prefixes.extend(forces.iter().map(|driver| prefix(&**driver)));
    prefixes.extend(lightings.iter().map(|driver| prefix(&**driver)));
    prefixes.extend(changers.iter().map(|driver| prefix(&**driver)));
    Ok(Loaded {
        prefixes,
        tables: Tables {
            sensor: table::<dyn Sensor>(sensors.len()),
            robot: table::<dyn Robot>(robots.len()),
            force: table::<dyn ForceTransducer>(forces.len()),
            lighting: table::<dyn Lighting>(lightings.len()),
            changer: table::<dyn Changer>(changers.len()),
            estimator: count(estimators.len()).map(estimator::table),
        },
        sensors,
        robots,
        forces,
        lightings,
        changers,
        estimators,
    })
}

fn prefix<D: ?Sized>(factory: &dyn CoreFactory<D>) -> String {
    let key = factory.descriptor().key().as_str();
    key.rsplit_once('/')
        .map_or("", |(prefix, _)| prefix)
        .to_owned()
}

fn table<D: Kind + ?Sized>(drivers: usize) -> Option<Factory> {
    count(drivers).map(factory::table::<D>)
}

/// Number of drivers in a table; `None` for 0, which needs no table.
fn count(drivers: usize) -> Option<u32> {
    u32::try_from(drivers).ok().filter(|count| *count > 0)
}

pub(crate) unsafe extern "C" fn deinit() {
    host::forget();
}

pub(crate) unsafe extern "C" fn factory(id: Text) -> *const c_void {
    // SAFETY: the host lends the text for the call.
    let found = caught(|| unsafe { memory::text("id", id) }.map(find));
    found.unwrap_or_else(Err).unwrap_or(null())
}

fn find(id: &str) -> *const c_void {
    fn address<T>(table: &Option<T>) -> *const c_void {
        table
            .as_ref()
            .map_or(null(), |table| std::ptr::from_ref(table).cast())
    }
    let Ok(Loaded { tables, .. }) = loaded() else {
        return null();
    };
    match id {
        SENSOR_FACTORY => address(&tables.sensor),
        ROBOT_FACTORY => address(&tables.robot),
        FORCE_FACTORY => address(&tables.force),
        LIGHTING_FACTORY => address(&tables.lighting),
        CHANGER_FACTORY => address(&tables.changer),
        ESTIMATOR_FACTORY => address(&tables.estimator),
        _ => null(),
    }
}
