//! Drivers and estimators of a library, each compared with its manifest.

#![expect(unsafe_code, reason = "a plugin describes itself through its tables")]

use std::collections::BTreeMap;
use std::fmt;

use taceva_abi as abi;
use taceva_core::{ArgSpec, Args, Descriptor, DriverKey, DriverKind};

use super::Library;
use super::error::LoadProblem;
use crate::call::{ArgList, Failure, Taken, call, take};
use crate::descriptor::{arguments, difference, difference_with};
use crate::id::PluginId;
use crate::manifest::{Manifest, Provided};

/// A driver or an estimator of a library.
#[derive(Debug)]
pub struct Entry {
    pub(crate) place: Place,
    /// Index in the factory.
    pub number: u32,
    /// Factory of a device kind; `None` for estimators.
    pub factory: Option<abi::Factory>,
    pub(crate) estimators: Option<abi::EstimatorFactory>,
    /// Description by the library, consistent with the manifest.
    pub provided: Provided,
    /// The library's description, as TOML text.
    pub(crate) text: String,
}

/// Factory of an entry.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Place {
    Driver(DriverKind),
    Estimator,
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Place::Driver(kind) => write!(f, "{kind} driver"),
            Place::Estimator => f.write_str("estimator"),
        }
    }
}

impl Entry {
    /// Declared arguments.
    pub fn arguments(&self) -> &[ArgSpec] {
        match &self.provided {
            Provided::Driver { descriptor, .. } => descriptor.arguments(),
            Provided::Estimator(estimator) => &estimator.settings,
        }
    }

    /// Library's description of the driver with `args`, checked against its description without arguments.
    pub(crate) fn describe(&self, id: &PluginId, args: &Args) -> Result<Descriptor, Failure> {
        let list = ArgList::new(args, self.arguments());
        let said = self.said(id, &list.args())?;
        let Provided::Driver { descriptor, .. } = &self.provided else {
            return Ok(said);
        };
        match difference_with(descriptor, &said, args) {
            None => Ok(said),
            Some([what, manifest, library]) => {
                let why = format!(
                    "with these arguments {what} is {library}, expected {manifest} as in the manifest; declare an argument that may change facts with `changes_facts = true`"
                );
                Err(Failure::new(taceva_core::ErrorKind::Abi, why))
            }
        }
    }

    /// Library's description of the driver with these arguments.
    fn said(&self, id: &PluginId, args: &abi::Args) -> Result<Descriptor, Failure> {
        let abi_fault = |why: String| Failure::new(taceva_core::ErrorKind::Abi, why);
        let Some(describe) = self.factory.and_then(|factory| factory.describe) else {
            return Err(abi_fault("its `describe` is NULL".to_owned()));
        };
        let mut taken = Taken::default();
        let context = taken.context();
        // SAFETY: [any], with arguments, a context and an error that outlive the call.
        call(|error| unsafe { describe(self.number, args, Some(take), context, error) })?;
        match Provided::parse(&taken.whole()?, id) {
            Ok(Provided::Driver { descriptor, .. }) => Ok(*descriptor),
            Ok(Provided::Estimator(_)) => Err(abi_fault("it describes an estimator".to_owned())),
            Err(error) => Err(abi_fault(format!("its description is invalid, {error}"))),
        }
    }

    /// One argument text for each connected device, which selects this device; `None` if the plugin cannot search.
    pub(crate) fn discover(&self) -> Result<Option<Vec<String>>, Failure> {
        let Some(discover) = self.factory.and_then(|factory| factory.discover) else {
            return Ok(None);
        };
        let mut taken = Taken::default();
        let context = taken.context();
        // SAFETY: [any], with a context and an error that outlive the call.
        call(|error| unsafe { discover(self.number, Some(take), context, error) })?;
        taken.texts().map(Some)
    }
}

/// Id of the factory of force transducers in libraries that were built for a minor version below [`NEW_FORCE_MINOR`]. Their torques are in N·m.
const EARLIER_FORCE_FACTORY: &str = "taceva.force/1";

const FACTORIES: [(DriverKind, &str); 6] = [
    (DriverKind::Sensor, abi::SENSOR_FACTORY),
    (DriverKind::Robot, abi::ROBOT_FACTORY),
    (DriverKind::Force, abi::FORCE_FACTORY),
    (DriverKind::Force, EARLIER_FORCE_FACTORY),
    (DriverKind::Lighting, abi::LIGHTING_FACTORY),
    (DriverKind::Changer, abi::CHANGER_FACTORY),
];

/// Maximum number of drivers in a factory.
const DRIVERS_MAX: u32 = 256;

/// All entries of `library`. Fails if they differ from `manifest`.
pub(super) fn entries(
    library: &Library,
    manifest: Option<&Manifest>,
) -> Result<BTreeMap<DriverKey, Entry>, LoadProblem> {
    let mut said = BTreeMap::new();
    for (kind, id) in FACTORIES {
        if id == EARLIER_FORCE_FACTORY && library.minor() >= NEW_FORCE_MINOR {
            continue;
        }
        let Some(factory) = library.device_factory(id)? else {
            continue;
        };
        let (Some(describe), Some(_)) = (factory.describe, factory.open) else {
            let what = factory.describe.map_or("describe", |_| "open");
            return Err(LoadProblem::Lacks { what });
        };
        for number in 0..count(factory.drivers)? {
            let place = Place::Driver(kind);
            // NULL requests the description without arguments.
            let args: *const abi::Args = std::ptr::null();
            let (provided, text) = described(library, place, number, |taken, error| {
                // SAFETY: [any], without arguments, with a context and an error that outlive the call.
                unsafe { describe(number, args, Some(take), taken, error) }
            })?;
            let entry = Entry {
                place,
                number,
                factory: Some(factory),
                estimators: None,
                provided,
                text,
            };
            insert(&mut said, entry)?;
        }
    }
    if let Some(factory) = library.estimator_factory()? {
        let (Some(describe), Some(_)) = (factory.describe, factory.fit) else {
            let what = factory.describe.map_or("describe", |_| "fit");
            return Err(LoadProblem::Lacks { what });
        };
        for number in 0..count(factory.estimators)? {
            let place = Place::Estimator;
            let (provided, text) = described(library, place, number, |taken, error| {
                // SAFETY: [any], with a context and an error that outlive the call.
                unsafe { describe(number, Some(take), taken, error) }
            })?;
            let entry = Entry {
                place,
                number,
                factory: None,
                estimators: Some(factory),
                provided,
                text,
            };
            insert(&mut said, entry)?;
        }
    }
    if let Some(manifest) = manifest {
        agree(&said, manifest)?;
    }
    Ok(said)
}

fn count(drivers: u32) -> Result<u32, LoadProblem> {
    if drivers > DRIVERS_MAX {
        let problem = format!("a factory of {drivers} drivers, expected at most {DRIVERS_MAX}");
        return Err(LoadProblem::Table(problem));
    }
    Ok(drivers)
}

fn described(
    library: &Library,
    place: Place,
    number: u32,
    describe: impl FnOnce(*mut std::ffi::c_void, &mut abi::Error) -> abi::Status,
) -> Result<(Provided, String), LoadProblem> {
    let mut taken = Taken::default();
    let context = taken.context();
    call(|error| describe(context, error)).map_err(LoadProblem::Describe)?;
    let text = taken.whole().map_err(LoadProblem::Describe)?;
    let driver = || format!("{place} {number}");
    let provided =
        Provided::parse(&text, &library.id).map_err(|source| LoadProblem::Describes {
            driver: driver(),
            source,
        })?;
    let said = place_of(&provided);
    if said != place {
        return Err(LoadProblem::Table(format!(
            "its description of {} states {said}, expected {place} as in its factory",
            driver()
        )));
    }
    Ok((provided, text))
}

fn place_of(provided: &Provided) -> Place {
    match provided {
        Provided::Driver { descriptor, .. } => Place::Driver(descriptor.kind()),
        Provided::Estimator(_) => Place::Estimator,
    }
}

fn insert(said: &mut BTreeMap<DriverKey, Entry>, entry: Entry) -> Result<(), LoadProblem> {
    let key = entry.provided.key().clone();
    if said.contains_key(&key) {
        let problem = format!("two of its drivers have the key `{key}`");
        return Err(LoadProblem::Table(problem));
    }
    said.insert(key, entry);
    Ok(())
}

/// Fails if the entries of a library differ from its manifest.
fn agree(said: &BTreeMap<DriverKey, Entry>, manifest: &Manifest) -> Result<(), LoadProblem> {
    let module = manifest.module().map(|module| module.name.clone());
    let differs = |what: String, manifest: &str, library: &str| LoadProblem::Differs {
        what,
        manifest: manifest.to_owned(),
        library: library.to_owned(),
        module: module.clone(),
    };
    for promised in &manifest.provides {
        let key = promised.key();
        let Some(entry) = said.get(key) else {
            return Err(differs(format!("`{key}`"), "present", "absent"));
        };
        match (promised, &entry.provided) {
            (
                Provided::Driver { descriptor, .. },
                Provided::Driver {
                    descriptor: found, ..
                },
            ) => {
                if let Some([what, manifest, library]) = difference(descriptor, found) {
                    let what = format!("`{key}`, {what}");
                    return Err(differs(what, &manifest, &library));
                }
            }
            (Provided::Estimator(promised), Provided::Estimator(found)) => {
                let settings = [&promised.settings, &found.settings].map(Vec::as_slice);
                if let Some([what, manifest, library]) = arguments(settings) {
                    let what = format!("`{key}`, {what}");
                    return Err(differs(what, &manifest, &library));
                }
            }
            (promised, found) => {
                let [promised, found] = [promised, found].map(|one| place_of(one).to_string());
                return Err(differs(format!("`{key}`"), &promised, &found));
            }
        }
    }
    let is_promised = |key: &&DriverKey| manifest.provides.iter().any(|one| one.key() == *key);
    match said.keys().find(|key| !is_promised(key)) {
        Some(key) => Err(differs(format!("`{key}`"), "absent", "present")),
        None => Ok(()),
    }
}

/// First minor version in which the factory of force transducers has a new id and torques are in N·mm.
pub(crate) const NEW_FORCE_MINOR: u32 = 3;
